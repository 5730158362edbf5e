import type { Crossing, DliMessage } from '../contract';
import { Comparison, instrumentKeys, instruments, type InstrumentKey, type Reading } from './instruments';
import { dliKey, mavlinkKey } from './traffic';

/** What crosses the bridge again and again: one MAVLink message type of one component, or one DLI message of the clock. */
export interface Flow {
  key: string;
  title: string;
  crossing: Crossing; // the newest
  numbers: number[]; // of the DLI messages that it has become so far, in the order of their first time
}

/** The newest crossings of the watched vehicle, and its instruments on both sides. */
export class Crossings {
  private readonly byKey = new Map<string, Flow>();
  private readonly dliByNumber = new Map<number, DliMessage>();
  private readonly comparisons = instrumentKeys.map((key) => new Comparison(instruments[key]));

  add(crossings: Crossing[]): void {
    for (const crossing of [...crossings].sort((a, b) => a.number - b.number)) this.addOne(crossing);
  }

  /** Those that become DLI messages first, then by name. */
  flows(): Flow[] {
    const rank = ({ crossing, numbers }: Flow) => (crossing.mavlink === undefined ? 2 : numbers.length > 0 ? 0 : 1);
    return [...this.byKey.values()].sort((a, b) => rank(a) - rank(b) || a.title.localeCompare(b.title));
  }

  flow(key: string): Flow | undefined {
    return this.byKey.get(key);
  }

  newestDli(number: number): DliMessage | undefined {
    return this.dliByNumber.get(number);
  }

  readings(): Record<InstrumentKey, Reading> {
    return Object.fromEntries(instrumentKeys.map((key, index) => [key, this.comparisons[index]!.reading()])) as Record<
      InstrumentKey,
      Reading
    >;
  }

  private addOne(crossing: Crossing): void {
    const { mavlink, dli } = crossing;
    if (mavlink !== undefined) {
      const { name, instance } = mavlink;
      this.put(mavlinkKey(mavlink), instance === undefined ? name : `${name} ${instance.value}`, crossing);
      for (const comparison of this.comparisons) comparison.onMavlink(mavlink);
    }
    for (const message of dli) {
      if (mavlink === undefined) this.put(dliKey(message), `#${message.number} ${message.name}`, crossing);
      this.dliByNumber.set(message.number, message);
      for (const comparison of this.comparisons) comparison.onDli(message);
    }
  }

  private put(key: string, title: string, crossing: Crossing): void {
    const before = this.byKey.get(key)?.numbers ?? [];
    const added = crossing.dli.map((message) => message.number).filter((number) => !before.includes(number));
    this.byKey.set(key, { key, title, crossing, numbers: [...before, ...added] });
  }
}
