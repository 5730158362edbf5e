/**
 * One bar of a histogram: from and to in nanoseconds, and how high it is drawn: by the logarithm, so that a few slow
 * messages among thousands are seen.
 */
export interface Bar {
  from_ns: number;
  to_ns: number; // Infinity: the last one
  count: number;
  height: number; // 0..1
}

/** The bars from the first to the last that is not empty; none when all are. */
export function bars(bounds_ns: number[], buckets: number[]): Bar[] {
  const highest = Math.log1p(Math.max(1, ...buckets));
  const all = buckets.map((count, index) => ({
    from_ns: index === 0 ? 0 : bounds_ns[index - 1]!,
    to_ns: bounds_ns[index] ?? Infinity,
    count,
    height: Math.log1p(count) / highest,
  }));
  const first = all.findIndex((bar) => bar.count > 0);
  const last = all.findLastIndex((bar) => bar.count > 0);
  return first < 0 ? [] : all.slice(first, last + 1);
}
