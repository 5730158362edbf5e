import type { Reading } from '../../model/instruments';
import { degrees } from '../../model/units';
import { t } from '../../text';

const pixelsPerDegree = 1.6;
const pitchMarks = [-30, -20, -10, 10, 20, 30];

/** An artificial horizon: sky and ground as MAVLink tells them, a hollow horizon as the DLI does. */
export function AttitudeIndicator({ roll, pitch }: { roll: Reading; pitch: Reading }) {
  return (
    <svg class="dial attitude" viewBox="-60 -60 120 120" role="img" aria-label={t('instruments.attitude')}>
      <clipPath id="attitude-glass">
        <circle r="56" />
      </clipPath>
      <g clip-path="url(#attitude-glass)">
        <g transform={horizon(roll.mavlink ?? 0, pitch.mavlink ?? 0)}>
          <rect class="sky" x="-120" y="-200" width="240" height="200" />
          <rect class="ground" x="-120" y="0" width="240" height="200" />
          <line class="horizon" x1="-120" x2="120" />
          {pitchMarks.map((mark) => (
            <g key={mark}>
              <line class="mark" x1="-10" x2="10" y1={-mark * pixelsPerDegree} y2={-mark * pixelsPerDegree} />
              <text x="14" y={-mark * pixelsPerDegree + 2.5}>
                {Math.abs(mark)}
              </text>
            </g>
          ))}
        </g>
        {roll.dli !== undefined && pitch.dli !== undefined && (
          <g transform={horizon(roll.dli, pitch.dli)}>
            <rect class="overlay" x="-46" y="-2.5" width="30" height="5" />
            <rect class="overlay" x="16" y="-2.5" width="30" height="5" />
          </g>
        )}
      </g>
      <path class="aircraft" d="M-28 0H-10L0 8L10 0H28" />
      <circle class="rim" r="56" />
    </svg>
  );
}

function horizon(roll: number, pitch: number): string {
  return `rotate(${(-degrees(roll)).toFixed(2)}) translate(0 ${(degrees(pitch) * pixelsPerDegree).toFixed(2)})`;
}
