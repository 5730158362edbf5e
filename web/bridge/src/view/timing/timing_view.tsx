import { stageNames, type Timing } from '../../contract';
import { durationText } from '../../model/format';
import { delays, reading, timing } from '../../state/store';
import { t } from '../../text';
import { ColumnHeads } from '../shared/column_heads';
import { Panel } from '../shared/panel';
import { PauseButton } from '../shared/pause_button';
import { Histogram } from './histogram';
import { LatencyStudy } from './latency_study';
import { LiveChart } from './live_chart';

/** How long the translation takes. */
export function TimingView() {
  void reading.value;
  const now = timing.value;
  return (
    <>
      <div class="toolbar">
        <PauseButton />
      </div>
      <Panel title={t('timing.live')}>
        <LiveChart delays={delays.peek()} />
      </Panel>
      <div class="halves">
        <Panel title={t('timing.stages')}>
          {now && now.total.count > 0 ? <StageTable timing={now} /> : <p class="muted">{t('timing.none')}</p>}
        </Panel>
        <Panel title={t('timing.histogram')}>
          {now && now.total.count > 0 ? <Histogram timing={now} /> : <p class="muted">{t('timing.none')}</p>}
        </Panel>
      </div>
      <LatencyStudy />
    </>
  );
}

function StageTable({ timing: now }: { timing: Timing }) {
  const newest = delays.peek().at(-1);
  return (
    <div class="scroll">
      <table class="stages">
        <ColumnHeads titles={['', t('timing.newest'), 'p50', 'p95', 'p99', t('timing.max'), t('timing.count')]} />
        <tbody>
          {stageNames.map((name) => {
            const { p50_ns, p95_ns, p99_ns, max_ns, count } = now[name];
            return (
              <tr key={name}>
                <th scope="row">{t(`stage.${name}`)}</th>
                <td class="number">{newest ? durationText(newest.stages[name]) : '–'}</td>
                <td class="number">{durationText(p50_ns)}</td>
                <td class="number">{durationText(p95_ns)}</td>
                <td class="number">{durationText(p99_ns)}</td>
                <td class="number">{durationText(max_ns)}</td>
                <td class="number">{count}</td>
              </tr>
            );
          })}
        </tbody>
      </table>
    </div>
  );
}
