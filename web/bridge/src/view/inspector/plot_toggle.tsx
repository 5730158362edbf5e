import { Plot, type PlotSource } from '../../model/plot';
import { plots } from '../../state/store';
import { t } from '../../text';

/** Adds a field's curve to the plots, or takes it away. */
export function PlotToggle({ source, text }: { source: PlotSource; text: string }) {
  const plot = new Plot(source);
  const isPlotted = plots.value.some(({ title }) => title === plot.title);
  return (
    <button
      type="button"
      class="small"
      aria-pressed={isPlotted}
      aria-label={`${t('inspector.plot')}: ${plot.title}`}
      onClick={() => {
        const others = plots.value.filter(({ title }) => title !== plot.title);
        plots.value = isPlotted ? others : [...others, plot];
      }}
    >
      {isPlotted && <span aria-hidden="true">✓ </span>}
      {text}
    </button>
  );
}
