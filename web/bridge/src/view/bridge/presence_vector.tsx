import type { DliFieldInfo } from '../../contract';
import { hexOf } from '../../model/bytes';
import type { DliLayout } from '../../model/dli_layout';
import { t } from '../../text';

/** The presence vector in hexadecimal and bit by bit; each bit tells which field it stands for. */
export function PresenceVector(props: {
  bytes: Uint8Array;
  layout: DliLayout;
  isMarked: (field: DliFieldInfo) => boolean;
}) {
  const { bits, presence } = props.layout;
  return (
    <div class="presence">
      <p>
        {t('pane.presence')} <span class="code">{hexOf(props.bytes, presence)}</span>
      </p>
      <ol class="bits" aria-label={t('pane.presence')}>
        {bits.map(({ bit, present, field }) => {
          const meaning = `${t('pane.presence.bit')} ${bit}: ${field?.name ?? '—'}, ${t(present ? 'pane.present' : 'pane.absent')}`;
          const isMarked = field !== undefined && props.isMarked(field);
          return (
            <li key={bit} class={`${present ? 'set' : ''} ${isMarked ? 'marked' : ''}`} title={meaning}>
              <span aria-hidden="true">{present ? 1 : 0}</span>
              <span class="unseen">{meaning}</span>
            </li>
          );
        })}
      </ol>
    </div>
  );
}
