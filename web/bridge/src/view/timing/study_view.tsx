import type { StudyResult } from '../../contract';
import { durationText } from '../../model/format';
import { t } from '../../text';
import { Chart } from '../shared/chart';

const microseconds = (value: number) => (value < 0 ? `−${durationText(-value * 1000)}` : durationText(value * 1000));

/** The outcome of a latency study. */
export function StudyView({ result: { pass, limit_ms, samples, summary } }: { result: StudyResult }) {
  const rows = [
    ['study.mean', summary.mean_us],
    ['study.min', summary.min_us],
    ['timing.max', summary.max_us],
    ['study.deviation', summary.standard_deviation_us],
    ['study.slope', summary.slope_us_per_sample],
  ] as const;
  return (
    <>
      <p class={pass ? 'good' : 'bad'}>
        <b>
          {pass ? '✓' : '✖'} {t(pass ? 'study.pass' : 'study.fail')} ({limit_ms} ms)
        </b>
      </p>
      <div class="halves">
        <table>
          <caption>{t('study.delay')}</caption>
          <tbody>
            {rows.map(([key, value]) => (
              <tr key={key}>
                <th scope="row">{t(key)}</th>
                <td class="number">{microseconds(value)}</td>
              </tr>
            ))}
            <tr>
              <th scope="row">p95</th>
              <td class="number">{microseconds(summary.p95_us)}</td>
            </tr>
          </tbody>
        </table>
        <Chart
          label={t('study.title')}
          curves={[
            { label: t('study.direct'), style: 'mavlink' },
            { label: t('study.converted'), style: 'dli', dash: [6, 3] },
          ]}
          data={[
            samples.map((_, index) => index + 1),
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
