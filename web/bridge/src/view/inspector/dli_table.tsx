import type { DliMessage, DliRow } from '../../contract';
import { bytesOf } from '../../model/bytes';
import { dliLayout } from '../../model/dli_layout';
import { meaningText } from '../../model/format';
import { dliKey } from '../../model/traffic';
import { settings } from '../../state/settings';
import { catalogue } from '../../state/store';
import { t } from '../../text';
import { HexBytes } from '../shared/hex_bytes';
import { MessageTable } from './message_table';
import { PlotToggle } from './plot_toggle';

export function DliTable({ rows }: { rows: DliRow[] }) {
  return (
    <MessageTable
      fromTitle={t('inspector.source')}
      lines={rows.map(({ count, rate_hz, last }) => ({
        key: dliKey(last),
        title: `#${last.number} ${last.name}`,
        from: last.source,
        count,
        rate_hz,
        time_ms: last.time_ms,
        details: () => <Details message={last} />,
      }))}
    />
  );
}

function Details({ message }: { message: DliMessage }) {
  const bytes = bytesOf(message.hex);
  const { presence } = dliLayout(bytes, catalogue.value?.dli(message.number), message.fields);
  const values = { ...message.held, ...message.fields };
  return (
    <>
      <HexBytes
        label={`#${message.number}: ${t('pane.bytes')}`}
        bytes={bytes}
        regions={[{ name: 'presence', range: presence }]}
        marks={[]}
      />
      <dl class="values">
        {Object.entries(values).map(([key, value]) => {
          const { raw } = value;
          const meaning = meaningText(value, settings.units.value);
          return (
            <div key={key}>
              <dt>{key}</dt>
              <dd>
                <span class="number">{raw}</span>
                {meaning && <span class="meaning"> {meaning}</span>}
                {!(key in message.fields) && <i class="muted"> {t('pane.unchanged')}</i>}
                {typeof raw === 'number' && (
                  <PlotToggle
                    source={{ side: 'dli', source: message.source, number: message.number, field: key }}
                    text={t('inspector.plot')}
                  />
                )}
              </dd>
            </div>
          );
        })}
      </dl>
    </>
  );
}
