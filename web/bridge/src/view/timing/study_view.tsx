import { studySeries, type StudyResult } from '../../contract';
import { durationText } from '../../model/format';
import { t } from '../../text';
import { Chart } from '../shared/chart';
import { ColumnHeads } from '../shared/column_heads';

const microseconds = (value: number) => (value < 0 ? `−${durationText(-value * 1000)}` : durationText(value * 1000));

const rows = [
  ['study.mean', 'mean_us'],
  ['study.median', 'median_us'],
  ['study.p95', 'p95_us'],
  ['study.min', 'min_us'],
  ['timing.max', 'max_us'],
  ['study.deviation', 'standard_deviation_us'],
  ['study.slope', 'slope_us_per_sample'],
] as const;

/** The outcome of a latency study. */
export function StudyView({ result: { pass, limit_ms, samples, summary } }: { result: StudyResult }) {
  return (
    <>
      <p class={pass ? 'good' : 'bad'}>
        <b>
          {pass ? '✓' : '✖'} {t(pass ? 'study.pass' : 'study.fail')} ({limit_ms} ms)
        </b>
      </p>
      <div class="halves">
        <table>
          <ColumnHeads titles={['', ...studySeries.map((series) => t(`study.${series}`))]} />
          <tbody>
            {rows.map(([key, member]) => (
              <tr key={key}>
                <th scope="row">{t(key)}</th>
                {studySeries.map((series) => (
                  <td key={series} class="number">
                    {microseconds(summary[series][member])}
                  </td>
                ))}
              </tr>
            ))}
          </tbody>
        </table>
        <Chart
          label={t('study.title')}
          curves={[
            { label: t('study.direct'), style: 'mavlink' },
            { label: t('study.converted'), style: 'dli', dash: [6, 3] },
          ]}
          data={[
            samples.map(({ index }) => index),
            samples.map(({ direct_us }) => direct_us),
            samples.map(({ converted_us }) => converted_us),
          ]}
          time={false}
          valueText={microseconds}
        />
      </div>
    </>
  );
}
