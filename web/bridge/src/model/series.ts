/** Points of a curve, oldest first: at most `capacity`, the oldest give way. */
export class Series {
  readonly times: number[] = []; // s
  readonly values: (number | null)[] = []; // null: a gap

  constructor(private readonly capacity: number) {}

  /** A point that is not newer than the last one is left out. */
  add(time: number, value: number | null): void {
    const last = this.times.at(-1);
    if (last !== undefined && time <= last) return;
    this.times.push(time);
    this.values.push(value);
    if (this.times.length > this.capacity) {
      this.times.shift();
      this.values.shift();
    }
  }
}
