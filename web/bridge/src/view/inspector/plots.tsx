import { plain } from '../../model/format';
import type { Plot } from '../../model/plot';
import { plots, reading } from '../../state/store';
import { t } from '../../text';
import { Chart } from '../shared/chart';
import { Panel } from '../shared/panel';

/** The curves of the chosen fields, each in a chart of its own since their units differ. */
export function Plots() {
  return (
    <Panel title={t('inspector.plots')}>
      {plots.value.length === 0 && <p class="muted">{t('inspector.plots.none')}</p>}
      <div class="charts">
        {plots.value.map((plot) => (
          <PlotView key={plot.title} plot={plot} />
        ))}
      </div>
    </Panel>
  );
}

function PlotView({ plot }: { plot: Plot }) {
  void reading.value;
  const { title, source, series } = plot;
  const newest = series.values.at(-1);
  return (
    <figure>
      <figcaption>
        <b>{title}</b> <span class="number">{newest == null ? '–' : plain(newest)}</span>
        <button
          type="button"
          class="small"
          aria-label={`${t('inspector.unplot')}: ${title}`}
          onClick={() => (plots.value = plots.value.filter((other) => other !== plot))}
        >
          {t('inspector.unplot')}
        </button>
      </figcaption>
      <Chart
        label={title}
        curves={[{ label: source.field, style: source.side }]}
        data={[[...series.times], [...series.values]]}
        time
        valueText={plain}
      />
    </figure>
  );
}
