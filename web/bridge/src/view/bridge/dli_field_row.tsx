import type { DliFieldInfo, DliMessage, DliValue } from '../../contract';
import { degreesOfBinaryAngle, twosComplementHex } from '../../model/binary_angle';
import { hexOf, type Range } from '../../model/bytes';
import { fixed, meaningText } from '../../model/format';
import { settings } from '../../state/settings';
import { t } from '../../text';
import { FieldRow } from './field_table';

/** One field: of this message, held from an earlier one, or absent. */
export function DliFieldRow(props: {
  message: DliMessage;
  field: DliFieldInfo;
  isFirst: boolean;
  isMarked: boolean;
  bytes: Uint8Array;
  range: Range | undefined;
}) {
  const { message, field, range } = props;
  const present = message.fields[field.key];
  const value = present ?? message.held[field.key];
  return (
    <FieldRow
      target={{ side: 'dli', number: message.number, field: field.key }}
      name={field.name}
      aside={`${t('pane.presence.bit')} ${field.number - 1}`}
      isFirst={props.isFirst}
      isMarked={props.isMarked}
      isAbsent={present === undefined}
      hex={range && hexOf(props.bytes, range)}
      missing={t(value ? 'pane.unchanged' : 'pane.absent')}
      raw={value && <Raw field={field} value={value} />}
      value={value && meaningText(value, settings.units.value)}
    />
  );
}

function Raw({ field, value }: { field: DliFieldInfo; value: DliValue }) {
  if (field.type !== 'bam' || typeof value.raw !== 'number') return <>{value.raw}</>;
  return (
    <>
      {value.raw}
      <span class="binary-angle" title={t('pane.binaryAngle')}>
        BAM 0x{twosComplementHex(value.raw, field.width)} = {fixed(degreesOfBinaryAngle(value.raw, field.width), 3)}°
      </span>
    </>
  );
}
