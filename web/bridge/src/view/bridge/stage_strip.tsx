import type { Crossing } from '../../contract';
import { delayOf } from '../../model/delays';
import { durationText } from '../../model/format';
import { status } from '../../state/store';
import { t } from '../../text';

const stages = ['decode', 'translate', 'send'] as const;

/** How long one message took, by stage. */
export function StageStrip({ crossing }: { crossing: Crossing }) {
  const delay = delayOf(crossing);
  if (delay === undefined) return null;
  const { total } = delay.stages;
  const budget_ms = status.value?.budget_ms;
  return (
    <div class="stage-strip">
      <svg viewBox="0 0 100 6" preserveAspectRatio="none" aria-hidden="true">
        {stages.map((stage, index) => {
          const before = stages.slice(0, index).reduce((sum, name) => sum + delay.stages[name], 0);
          return (
            <rect
              key={stage}
              class={`stage ${stage}`}
              x={(100 * before) / total}
              width={(100 * delay.stages[stage]) / total}
              height="6"
            />
          );
        })}
      </svg>
      <dl>
        {stages.map((stage) => (
          <div key={stage}>
            <dt>
              <span class={`swatch ${stage}`} aria-hidden="true" /> {t(`stage.${stage}`)}
            </dt>
            <dd class="number">{durationText(delay.stages[stage])}</dd>
          </div>
        ))}
        <div>
          <dt>{t('stage.total')}</dt>
          <dd class="number">
            <b>{durationText(total)}</b>
          </dd>
        </div>
      </dl>
      {budget_ms !== undefined && (
        <p class="muted">
          {((total / (budget_ms * 1e6)) * 100).toPrecision(2)} % {t('timing.ofBudget')} ({budget_ms} ms)
        </p>
      )}
    </div>
  );
}
