import type { Reading } from '../../model/instruments';
import { degrees } from '../../model/units';
import { t } from '../../text';

const letters = ['N', 'E', 'S', 'W'];
const ticks = Array.from({ length: 36 }, (_, index) => index * 10);

/** A compass: a solid needle as MAVLink tells it, a hollow one as the DLI does. */
export function HeadingRose({ heading }: { heading: Reading }) {
  return (
    <svg class="dial" viewBox="-60 -60 120 120" role="img" aria-label={t('instruments.heading')}>
      <circle class="rim" r="56" />
      {ticks.map((angle) => (
        <line key={angle} class="mark" y1="-54" y2={angle % 90 === 0 ? -46 : -50} transform={`rotate(${angle})`} />
      ))}
      {letters.map((letter, index) => (
        <text
          key={letter}
          class="letter"
          transform={`rotate(${index * 90}) translate(0 -35) rotate(${-index * 90})`}
          y="4"
        >
          {letter}
        </text>
      ))}
      {heading.mavlink !== undefined && (
        <path class="needle" d="M0 -44L6 16L0 10L-6 16Z" transform={`rotate(${degrees(heading.mavlink).toFixed(2)})`} />
      )}
      {heading.dli !== undefined && (
        <path class="overlay" d="M0 -50L11 22L0 14L-11 22Z" transform={`rotate(${degrees(heading.dli).toFixed(2)})`} />
      )}
    </svg>
  );
}
