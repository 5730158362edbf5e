import type { MavlinkMessage, MavlinkRow } from '../../contract';
import { bytesOf } from '../../model/bytes';
import { shownText, valueText } from '../../model/format';
import { mavlinkLayout } from '../../model/mavlink_layout';
import { mavlinkKey } from '../../model/traffic';
import { shownFromWire } from '../../model/units';
import { settings } from '../../state/settings';
import { catalogue } from '../../state/store';
import { t } from '../../text';
import { HexBytes } from '../shared/hex_bytes';
import { MessageTable } from './message_table';
import { PlotToggle } from './plot_toggle';

export function MavlinkTable({ rows }: { rows: MavlinkRow[] }) {
  return (
    <MessageTable
      fromTitle={t('inspector.from')}
      lines={rows.map(({ count, rate_hz, last }) => ({
        key: mavlinkKey(last),
        title: `${last.name}${last.instance ? ` ${last.instance.field}=${last.instance.value}` : ''}`,
        from: `${last.link}/${last.system}/${last.component}`,
        count,
        rate_hz,
        time_ms: last.time_us / 1000,
        details: () => <Details message={last} />,
      }))}
    />
  );
}

function Details({ message }: { message: MavlinkMessage }) {
  const bytes = bytesOf(message.hex);
  const { payload } = mavlinkLayout(bytes);
  return (
    <>
      <HexBytes
        label={`${message.name}: ${t('pane.bytes')}`}
        bytes={bytes}
        regions={[{ name: 'payload', range: payload }]}
        marks={[]}
      />
      {message.fields ? (
        <dl class="values">
          {Object.entries(message.fields).map(([name, value]) => {
            const info = catalogue.value?.mavlink(message)?.fields.find((field) => field.name === name);
            const shown =
              typeof value === 'number' ? shownFromWire(value, info?.unit, settings.units.value) : undefined;
            const meaning = shown ? shownText(shown) : info && catalogue.value?.labelOf(info, value);
            return (
              <div key={name}>
                <dt>{name}</dt>
                <dd>
                  <span class="number">{valueText(value)}</span> <span class="muted">{info?.unit}</span>
                  {meaning !== undefined && <span class="meaning"> {meaning}</span>}
                  <FieldPlots message={message} field={name} />
                </dd>
              </div>
            );
          })}
        </dl>
      ) : (
        <p>{t('pane.unknown')}</p>
      )}
    </>
  );
}

/** A toggle for the field, or one for each element of an array; none for texts. */
function FieldPlots({ message, field }: { message: MavlinkMessage; field: string }) {
  const value = message.fields?.[field];
  if (Array.isArray(value))
    return (
      <span class="elements">
        {value.map((_, element) => (
          <PlotToggle
            key={element}
            source={{ side: 'mavlink', sample: message, field, element }}
            text={`[${element}]`}
          />
        ))}
      </span>
    );
  if (typeof value !== 'number') return null;
  return <PlotToggle source={{ side: 'mavlink', sample: message, field }} text={t('inspector.plot')} />;
}
