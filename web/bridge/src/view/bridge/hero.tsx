import type { Totals } from '../../contract';
import { durationText, sizeText } from '../../model/format';
import { status, timing } from '../../state/store';
import { t } from '../../text';
import { SideName } from '../shared/side';
import { BridgeDrawing } from './bridge_drawing';
import { ConvertSwitch } from './convert_switch';

/** What Ponte does, in one picture with live numbers. */
export function Hero() {
  const now = status.value;
  const median = timing.value?.total.count ? timing.value.total.p50_ns : undefined;
  return (
    <section class="hero" aria-label={t('app.tagline')}>
      <p class="tagline">{t('app.tagline')}</p>
      <p class="explanation muted">{t('app.explain')}</p>
      <Bank side="mavlink" totals={now?.mavlink} />
      <BridgeDrawing isOpen={now !== undefined && !now.conversion} />
      <Bank side="dli" totals={now?.dli} />
      <div class="deck">
        <ConvertSwitch />
        <p>
          {now && !now.conversion
            ? t('hero.off')
            : median !== undefined && (
                <>
                  {t('hero.takes')} <b class="number">{durationText(median)}</b>
                </>
              )}
        </p>
      </div>
    </section>
  );
}

function Bank({ side, totals }: { side: 'mavlink' | 'dli'; totals: Totals | undefined }) {
  return (
    <div class={`bank ${side}`}>
      <h2>
        {t(side === 'mavlink' ? 'hero.vehicle' : 'hero.station')} <SideName side={side} />
      </h2>
      <p>
        <b class="number large">{totals ? totals.rate_hz.toFixed(totals.rate_hz < 10 ? 1 : 0) : '–'}</b>{' '}
        {t('hero.perSecond')}
      </p>
      {totals && (
        <p class="muted number">
          {totals.messages} {t('hero.inAll')} · {sizeText(totals.bytes)}
          {totals.rejected > 0 && ` · ▲ ${totals.rejected} ${t('hero.rejected')}`}
        </p>
      )}
    </div>
  );
}
