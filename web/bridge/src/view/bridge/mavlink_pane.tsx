import type { MavlinkFieldInfo, MavlinkMessage } from '../../contract';
import { bytesOf, hexOf, type Range } from '../../model/bytes';
import { shownText, timeText, valueText } from '../../model/format';
import { mavlinkFieldRange, mavlinkLayout } from '../../model/mavlink_layout';
import { shownFromWire } from '../../model/units';
import { marked } from '../../state/selection';
import { settings } from '../../state/settings';
import { catalogue } from '../../state/store';
import { t } from '../../text';
import { HeaderTable } from '../shared/header_table';
import { HexBytes } from '../shared/hex_bytes';
import { FieldRow, FieldTable } from './field_table';

/** A MAVLink frame with all that is in it. */
export function MavlinkPane({ message }: { message: MavlinkMessage }) {
  const bytes = bytesOf(message.hex);
  const { header, payload } = mavlinkLayout(bytes);
  const fields = catalogue.value?.mavlink(message)?.fields ?? [];
  const isMarked = (field: MavlinkFieldInfo) => marked.value.mavlink.has(`${message.name}.${field.name}`);
  const marks = fields.filter(isMarked).map((field) => mavlinkFieldRange(field, payload));
  return (
    <>
      <h3>
        {message.name} <span class="muted">#{message.id}</span>
      </h3>
      <p class="muted">
        MAVLink {message.version} · {message.system}/{message.component} · {timeText(message.time_us / 1000)} UTC
      </p>
      <HexBytes
        label={`MAVLink: ${t('pane.bytes')}`}
        bytes={bytes}
        regions={[{ name: 'payload', range: payload }]}
        marks={marks}
      />
      {message.fields ? (
        <FieldTable>
          {fields.map((field, index) => (
            <MavlinkFieldRow
              key={field.name}
              message={message}
              field={field}
              isFirst={index === 0}
              isMarked={isMarked(field)}
              bytes={bytes}
              range={mavlinkFieldRange(field, payload)}
            />
          ))}
        </FieldTable>
      ) : (
        <p>{t('pane.unknown')}</p>
      )}
      <HeaderTable title={t('pane.header')} bytes={bytes} fields={header} />
    </>
  );
}

function MavlinkFieldRow(props: {
  message: MavlinkMessage;
  field: MavlinkFieldInfo;
  isFirst: boolean;
  isMarked: boolean;
  bytes: Uint8Array;
  range: Range;
}) {
  const { message, field, range } = props;
  const value = message.fields?.[field.name] ?? '';
  const converted = typeof value === 'number' ? shownFromWire(value, field.unit, settings.units.value) : undefined;
  return (
    <FieldRow
      target={{ side: 'mavlink', message: message.name, field: field.name }}
      name={field.name}
      aside={field.unit}
      isFirst={props.isFirst}
      isMarked={props.isMarked}
      isAbsent={false}
      hex={range.end > range.start ? hexOf(props.bytes, range) : undefined}
      missing={t('pane.notSent')}
      raw={valueText(value)}
      value={converted ? shownText(converted) : catalogue.value?.labelOf(field, value)}
    />
  );
}
