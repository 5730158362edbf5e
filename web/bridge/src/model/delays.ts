import type { Crossing, StageName } from '../contract';

/** How long one message took, by stage, in nanoseconds. */
export interface Delay {
  time: number; // when it was received, s
  stages: Record<StageName, number>;
}

const capacity = 1500;

/** The delays of a crossing; nothing where it became no DLI message. */
export function delayOf({ mavlink, stages_ns }: Crossing): Delay | undefined {
  if (mavlink === undefined || stages_ns?.translated === undefined || stages_ns.sent === undefined) return undefined;
  const { decoded, translated, sent } = stages_ns;
  return {
    time: mavlink.time_us / 1e6,
    stages: { decode: decoded, translate: translated - decoded, send: sent - translated, total: sent },
  };
}

/** The delays of the last crossings, by time: at most 1500, the oldest give way. */
export function withDelays(delays: Delay[], crossings: Crossing[]): Delay[] {
  const added = crossings.map(delayOf).filter((delay) => delay !== undefined);
  if (added.length === 0) return delays;
  return [...delays, ...added].sort((a, b) => a.time - b.time).slice(-capacity);
}
