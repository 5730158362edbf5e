import { useSignal, useSignalEffect } from '@preact/signals';
import { useRef } from 'preact/hooks';
import { numbersOf } from '../../state/actions';
import { live, motion } from '../../state/store';

interface Traveller {
  number: number;
  from: string;
  to: string;
}

/** How long the animation of the style sheet takes. */
const crossing_ms = 4000;
/** Travellers start at least this far apart, so that they can be read. */
const spacing_px = 150;
const travellersAtOnce = 6;

/** The bridge: messages go over it and change their name in the middle; while it is open nothing crosses. */
export function BridgeDrawing({ isOpen }: { isOpen: boolean }) {
  const travellers = useSignal<Traveller[]>([]);
  const place = useRef<HTMLDivElement>(null);
  const lastStart = useRef(0);
  const turn = useRef(0);
  useSignalEffect(() => {
    const spacing_ms = (crossing_ms * spacing_px) / (place.current?.clientWidth ?? 1);
    if (motion.value === 0 || document.hidden || performance.now() - lastStart.current < spacing_ms) return;
    const flows = live.crossings.flows().filter(({ numbers }) => numbers.length > 0);
    const flow = flows[turn.current++ % flows.length];
    const from = flow?.crossing.mavlink?.name;
    if (from === undefined) return;
    lastStart.current = performance.now();
    const traveller = { number: turn.current, from, to: `#${numbersOf(flow!)[0]}` };
    travellers.value = [...travellers.peek(), traveller].slice(-travellersAtOnce);
  });
  return (
    <div ref={place} class={`bridge-drawing ${isOpen ? 'is-open' : ''}`} aria-hidden="true">
      <svg viewBox="0 0 600 110" preserveAspectRatio="xMidYMax meet">
        <path class="cable" d="M0 78 Q75 74 120 14 Q300 120 480 14 Q525 74 600 78" />
        <path class="hangers" d={hangers()} />
        <path class="tower" d="M120 10V104M480 10V104" />
        <path class="road left" d="M0 80H300" />
        <path class="road right" d="M300 80H600" />
        <path
          class="water"
          d="M0 104Q25 98 50 104T100 104T150 104T200 104T250 104T300 104T350 104T400 104T450 104T500 104T550 104T600 104"
        />
      </svg>
      {!isOpen &&
        travellers.value.map(({ number, from, to }) => (
          <span
            key={number}
            class="traveller"
            onAnimationEnd={(event) => {
              // The names inside change by animations of their own, which end earlier.
              if (event.target !== event.currentTarget) return;
              travellers.value = travellers.value.filter((other) => other.number !== number);
            }}
          >
            <span class="before">● {from}</span>
            <span class="after">■ {to}</span>
          </span>
        ))}
    </div>
  );
}

// Vertical lines from the main cable (the parabola of the path above) to the road.
function hangers(): string {
  const lines = [];
  for (let x = 150; x < 480; x += 30) {
    const share = (x - 120) / 360;
    const y = (1 - share) ** 2 * 14 + 2 * share * (1 - share) * 120 + share ** 2 * 14;
    lines.push(`M${x} ${y.toFixed(1)}V80`);
  }
  return lines.join('');
}
