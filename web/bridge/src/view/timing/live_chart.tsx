import { useMemo } from 'preact/hooks';
import type { Delay } from '../../model/delays';
import { durationText } from '../../model/format';
import { status } from '../../state/store';
import { t } from '../../text';
import { Chart } from '../shared/chart';

/** The stages of the last messages on a logarithmic scale, under the budget that they must keep. */
export function LiveChart({ delays }: { delays: Delay[] }) {
  const budget_ns = (status.value?.budget_ms ?? 0) * 1e6;
  const data = useMemo(() => curvesOf(delays, budget_ns), [delays, budget_ns]);
  if (delays.length === 0) return <p class="muted">{t('timing.none')}</p>;
  return (
    <Chart
      label={t('timing.live')}
      curves={[
        { label: t('stage.total'), style: 'total' },
        { label: t('stage.decode'), style: 'decode', dash: [1, 3] },
        { label: t('stage.translate'), style: 'translate', dash: [6, 3] },
        { label: t('stage.send'), style: 'send', dash: [2, 2] },
        { label: t('timing.budget'), style: 'limit', dash: [12, 4] },
      ]}
      data={data}
      time
      logarithmic
      valueText={durationText}
    />
  );
}

function curvesOf(delays: Delay[], budget_ns: number): [number[], ...(number | null)[][]] {
  // A logarithmic scale has no place for 0.
  const curve = (stage: keyof Delay['stages']) => delays.map(({ stages }) => Math.max(1, stages[stage]));
  const budget = delays.map(() => budget_ns);
  return [delays.map(({ time }) => time), curve('total'), curve('decode'), curve('translate'), curve('send'), budget];
}
