/** The sign of a side: a circle for MAVLink, a square for STANAG 4586; the colour only repeats the shape. */
export function SideSign({ side }: { side: 'mavlink' | 'dli' }) {
  return (
    <span class={`sign ${side}`} aria-hidden="true">
      {side === 'mavlink' ? '●' : '■'}
    </span>
  );
}

export function SideName({ side }: { side: 'mavlink' | 'dli' }) {
  return (
    <span class={`side-name ${side}`}>
      <SideSign side={side} /> {side === 'mavlink' ? 'MAVLink' : 'STANAG 4586'}
    </span>
  );
}
