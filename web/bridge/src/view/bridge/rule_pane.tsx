import type { Confidence, FromMavlinkRule } from '../../contract';
import type { Chain } from '../../model/catalogue';
import { selection, type Selection } from '../../state/selection';
import { catalogue } from '../../state/store';
import { t } from '../../text';
import { SideSign } from '../shared/side';

const confidenceSigns: Record<Confidence, string> = {
  standard: '◆◆◆',
  single_source: '◆◆◇',
  inferred: '◆◇◇',
  unknown: '◇◇◇',
};

/** How the field that is pointed at comes from one language into the other. */
export function RulePane() {
  const chosen = selection.value;
  if (chosen === undefined) return <p>{t('rule.hint')}</p>;
  const chains = chainsOf(chosen);
  if (chains.length > 0)
    return (
      <>
        {chains.map((chain, index) => (
          <ChainView key={index} chain={chain} />
        ))}
        <p class="muted">{t('rule.hint')}</p>
      </>
    );
  const isOwn = chosen.side === 'dli' && chosen.field === 'time_stamp';
  return <p>{t(isOwn ? 'rule.constant' : 'rule.none')}</p>;
}

function chainsOf(chosen: Selection): Chain[] {
  const known = catalogue.value;
  if (known === undefined) return [];
  if (chosen.side === 'dli') return known.chainsOf(chosen.number, chosen.field);
  return known
    .targetsOf(chosen.message, chosen.field)
    .flatMap(({ number, field }) => known.chainsOf(number, field))
    .map(({ toDli, fromMavlink }) => ({
      toDli,
      fromMavlink: fromMavlink.filter(({ message }) => message === chosen.message),
    }))
    .filter(({ fromMavlink }) => fromMavlink.length > 0);
}

function ChainView({ chain: { toDli, fromMavlink } }: { chain: Chain }) {
  const info = catalogue.value?.dli(toDli.number);
  const field = info?.fields.find(({ key }) => key === toDli.field);
  return (
    <div class="chain">
      {fromMavlink.map((rule) => (
        <FromRule key={`${rule.message} ${rule.fact}`} rule={rule} />
      ))}
      <p class="step">
        <span class="arrow" aria-hidden="true">
          ↓
        </span>{' '}
        <q>{toDli.rule}</q>
      </p>
      <p class="end dli">
        <SideSign side="dli" /> #{toDli.number} {field?.name ?? toDli.field}
      </p>
      <p class="muted">
        {t('rule.reference')}: {toDli.reference}
        <br />
        {t('rule.confidence')}: <span aria-hidden="true">{confidenceSigns[toDli.confidence]}</span>{' '}
        {t(`confidence.${toDli.confidence}`)}
        {field?.guessed && `, ${t('rule.guessed')}`}
      </p>
    </div>
  );
}

function FromRule({ rule }: { rule: FromMavlinkRule }) {
  return (
    <>
      <p class="end mavlink">
        <SideSign side="mavlink" /> {rule.message} {[...new Set(rule.sources)].join(', ')}
        {rule.rank > 0 && <span class="muted"> ({t('rule.backup')})</span>}
      </p>
      <p class="step">
        <span class="arrow" aria-hidden="true">
          ↓
        </span>{' '}
        <q>{rule.rule}</q>
      </p>
      <p class="fact">
        {t('rule.fact')} <b>{rule.fact}</b> {rule.unit && <span class="muted">{rule.unit}</span>}
      </p>
    </>
  );
}
