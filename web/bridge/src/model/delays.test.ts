import { expect, it } from 'vitest';
import type { Crossing } from '../contract';
import { delayOf, withDelays } from './delays';

const crossing = (time_us: number, stages_ns: Crossing['stages_ns']) =>
  ({ number: 1, mavlink: { name: 'ATTITUDE', time_us }, stages_ns, dli: [] }) as unknown as Crossing;
const sent = { decoded: 3000, translated: 13_000, sent: 30_000 };

it('splits the time into stages that add up', () => {
  expect(delayOf(crossing(5e6, sent))).toEqual({
    time: 5,
    stages: { decode: 3000, translate: 10_000, send: 17_000, total: 30_000 },
  });
});

it('has nothing to say of a message that was not sent', () => {
  expect(delayOf(crossing(5e6, { decoded: 3000 }))).toBeUndefined();
});

it('keeps the last 1500, in the order of time', () => {
  const many = Array.from({ length: 1600 }, (_, index) => crossing((1600 - index) * 1e6, sent));
  const delays = withDelays([], many);
  expect(delays).toHaveLength(1500);
  expect([delays[0]!.time, delays.at(-1)!.time]).toEqual([101, 1600]);
});
