import { useEffect, useRef } from 'preact/hooks';
import type uPlot from 'uplot';
import { plain } from '../../model/format';
import { settings } from '../../state/settings';

/** One curve: its name, and which colour and dash of the style sheet it has. */
export interface Curve {
  label: string;
  style: 'mavlink' | 'dli' | 'decode' | 'translate' | 'send' | 'total' | 'limit';
  dash?: number[];
}

export interface ChartProps {
  label: string; // for those who cannot see it
  curves: Curve[];
  data: uPlot.AlignedData; // x first, then one array for each curve
  time: boolean; // x is in seconds since 1970
  logarithmic?: boolean;
  valueText: (value: number) => string;
}

const height = 220;

/** Curves over time or over a number. The drawing library is loaded when the first chart is shown. */
export function Chart(props: ChartProps) {
  const place = useRef<HTMLDivElement>(null);
  const chart = useRef<uPlot | undefined>(undefined);
  const newest = useRef(props.data);
  newest.current = props.data;
  const theme = settings.theme.value;
  const names = props.curves.map(({ label }) => label).join();

  useEffect(() => {
    const element = place.current!;
    const fit = new ResizeObserver(() => chart.current?.setSize({ width: element.clientWidth, height }));
    let isGone = false;
    void Promise.all([import('uplot'), import('uplot/dist/uPlot.min.css')]).then(([{ default: Plot }]) => {
      if (isGone) return;
      chart.current = new Plot(options(props, element), newest.current, element);
      fit.observe(element);
    });
    return () => {
      isGone = true;
      fit.disconnect();
      chart.current?.destroy();
      chart.current = undefined;
    };
  }, [theme, names]);

  useEffect(() => chart.current?.setData(props.data), [props.data]);

  return <div ref={place} class="chart" role="img" aria-label={props.label} />;
}

function options(props: ChartProps, element: HTMLElement): uPlot.Options {
  // The canvas needs a plain colour, which only a real property gives.
  const colour = (name: string) => {
    element.style.color = `var(--${name})`;
    const resolved = getComputedStyle(element).color;
    element.style.color = '';
    return resolved;
  };
  const axis = { stroke: colour('ink'), grid: { stroke: colour('line'), width: 1 }, ticks: { stroke: colour('line') } };
  const decades = props.logarithmic ? { filter: decadesOf } : {};
  return {
    width: element.clientWidth,
    height,
    cursor: { y: false },
    scales: { x: { time: props.time }, y: props.logarithmic ? { distr: 3 } : {} },
    axes: [
      { ...axis, space: 90, values: (_, values) => values.map((value) => xText(props, value)) },
      {
        ...axis,
        grid: { ...axis.grid, ...decades },
        ticks: { ...axis.ticks, ...decades },
        size: 64,
        values: (_, values) => values.map((value) => (value === null ? '' : props.valueText(value))),
      },
    ],
    series: [
      { label: props.time ? 'UTC' : '#', value: (_, value) => (value == null ? '–' : xText(props, value)) },
      ...props.curves.map(({ label, style: name, dash }) => ({
        label,
        stroke: colour(name),
        width: 1.5,
        points: { show: false },
        ...(dash && { dash }),
        value: (_: uPlot, value: number | null) => (value === null ? '–' : props.valueText(value)),
      })),
    ],
  };
}

// Lines at the powers of ten only.
function decadesOf(_: uPlot, splits: number[]): (number | null)[] {
  return splits.map((value) => (Number.isInteger(Math.log10(value)) ? value : null));
}

function xText({ time }: ChartProps, value: number): string {
  return time ? new Date(value * 1000).toISOString().slice(11, 21) : plain(value);
}
