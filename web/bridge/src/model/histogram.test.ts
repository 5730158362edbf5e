import { expect, it } from 'vitest';
import { bars } from './histogram';

it('leaves out the empty ends and keeps the gaps', () => {
  const drawn = bars([10, 20, 50, 100], [0, 3, 0, 1, 0]);
  expect(drawn.map(({ from_ns, to_ns, count }) => [from_ns, to_ns, count])).toEqual([
    [10, 20, 3],
    [20, 50, 0],
    [50, 100, 1],
  ]);
  expect(drawn[0]!.height).toBe(1);
  expect(drawn[2]!.height).toBe(0.5);
});

it('has no upper end for what is longer than every bound', () => {
  expect(bars([10], [0, 2])).toEqual([{ from_ns: 10, to_ns: Infinity, count: 2, height: 1 }]);
});

it('draws nothing where nothing was counted', () => {
  expect(bars([10], [0, 0])).toEqual([]);
});
