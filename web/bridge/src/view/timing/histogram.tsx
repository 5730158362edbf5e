import { signal } from '@preact/signals';
import { stageNames, type StageName, type Timing } from '../../contract';
import { durationText } from '../../model/format';
import { bars } from '../../model/histogram';
import { status } from '../../state/store';
import { t } from '../../text';
import { Choice } from '../shared/choice';

const barWidth = 40;
const height = 130;
const labelRoom = 34;

const stage = signal<StageName>('total');

/** How many messages took how long, for one stage or in all. */
export function Histogram({ timing }: { timing: Timing }) {
  const all = bars(timing.bounds_ns, timing[stage.value].buckets);
  const width = Math.max(all.length, 6) * barWidth;
  const upTo = (to_ns: number) => (to_ns === Infinity ? '∞' : `≤ ${durationText(to_ns)}`);
  const summary = all.map(({ to_ns, count }) => `${upTo(to_ns)}: ${count}`).join('; ');
  return (
    <>
      <Choice
        label={t('timing.stage')}
        setting={stage}
        options={stageNames.map((name) => [name, t(`stage.${name}`)])}
      />
      <div class="scroll">
        <svg
          class="histogram"
          viewBox={`0 0 ${width} ${height + labelRoom}`}
          role="img"
          aria-label={`${t('timing.histogram')}: ${summary}`}
        >
          {all.map(({ to_ns, count, height: share }, index) => {
            const barHeight = share * (height - 16);
            return (
              <g key={to_ns} transform={`translate(${index * barWidth} 0)`}>
                <rect x="3" y={height - barHeight} width={barWidth - 6} height={barHeight} />
                <text x={barWidth / 2} y={height - barHeight - 4}>
                  {count}
                </text>
                <text x={barWidth / 2} y={height + (index % 2 === 0 ? 13 : 27)}>
                  {upTo(to_ns)}
                </text>
              </g>
            );
          })}
          <line x2={width} y1={height} y2={height} />
        </svg>
      </div>
      <p class="muted">
        {t('timing.logarithmic')} {t('timing.budget')}: {status.value?.budget_ms} ms
      </p>
    </>
  );
}
