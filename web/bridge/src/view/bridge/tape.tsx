import type { Reading } from '../../model/instruments';

const height = 120;
const stepsVisible = 5;

/** A vertical scale that slides past the MAVLink value; a hollow pointer shows where the DLI value stands on it. */
export function Tape(props: {
  label: string;
  reading: Reading;
  scale: (si: number) => { value: number; unit: string };
  step: number;
}) {
  const { reading, scale, step } = props;
  const value = reading.mavlink === undefined ? undefined : scale(reading.mavlink).value;
  const overlay = reading.dli === undefined ? undefined : scale(reading.dli).value;
  const pixels = height / (stepsVisible * step);
  const middle = value ?? overlay ?? 0;
  const y = (mark: number) => Math.max(-58, Math.min(58, (middle - mark) * pixels));
  const first = Math.ceil((middle - (stepsVisible / 2) * step) / step) * step;
  const inside = (mark: number) => Math.abs(y(mark)) < 54; // with its text
  const marks = Array.from({ length: stepsVisible }, (_, index) => first + index * step).filter(inside);
  return (
    <figure class="tape">
      <svg class="dial" viewBox="-36 -60 72 120" role="img" aria-label={props.label}>
        <rect class="rim" x="-35" y="-59" width="70" height="118" rx="4" />
        {marks.map((mark) => (
          <g key={mark}>
            <line class="mark" x1="-35" x2="-26" y1={y(mark)} y2={y(mark)} />
            <text x="-22" y={y(mark) + 3}>
              {mark}
            </text>
          </g>
        ))}
        {value !== undefined && <path class="needle" d="M34 -7L16 0L34 7Z" />}
        {overlay !== undefined && (
          <path class="overlay" d={`M34 ${y(overlay) - 11}L8 ${y(overlay)}L34 ${y(overlay) + 11}Z`} />
        )}
      </svg>
      <figcaption>
        {props.label} ({scale(0).unit})
      </figcaption>
    </figure>
  );
}
