import type { DliFieldInfo, DliMessage } from '../../contract';
import { bytesOf } from '../../model/bytes';
import { dliLayout } from '../../model/dli_layout';
import { timeText } from '../../model/format';
import { marked } from '../../state/selection';
import { catalogue } from '../../state/store';
import { t } from '../../text';
import { HeaderTable } from '../shared/header_table';
import { HexBytes } from '../shared/hex_bytes';
import { DliFieldRow } from './dli_field_row';
import { FieldTable } from './field_table';
import { PresenceVector } from './presence_vector';

/** A DLI message with all that is in it. */
export function DliPane({ message }: { message: DliMessage }) {
  const bytes = bytesOf(message.hex);
  const info = catalogue.value?.dli(message.number);
  const layout = dliLayout(bytes, info, message.fields);
  const isMarked = (field: DliFieldInfo) => marked.value.dli.has(`${message.number}.${field.key}`);
  const fields = info?.fields ?? [];
  const marks = fields.filter(isMarked).flatMap(({ key }) => layout.fields.get(key) ?? []);
  const data = { start: layout.presence.end, end: Math.max(0, ...[...layout.fields.values()].map(({ end }) => end)) };
  return (
    <>
      <h3>
        #{message.number} <span>{message.name}</span>
      </h3>
      <p class="muted">
        Ed. {message.edition} · {message.source} → {message.destination} · {timeText(message.time_ms)} UTC
      </p>
      <HexBytes
        label={`STANAG 4586: ${t('pane.bytes')}`}
        bytes={bytes}
        regions={[
          { name: 'presence', range: layout.presence },
          { name: 'payload', range: data },
        ]}
        marks={marks}
      />
      <PresenceVector bytes={bytes} layout={layout} isMarked={isMarked} />
      <FieldTable>
        {fields.map((field, index) => (
          <DliFieldRow
            key={field.key}
            message={message}
            field={field}
            isFirst={index === 0}
            isMarked={isMarked(field)}
            bytes={bytes}
            range={layout.fields.get(field.key)}
          />
        ))}
      </FieldTable>
      <HeaderTable title={t('pane.wrapper')} bytes={bytes} fields={layout.wrapper} />
    </>
  );
}
