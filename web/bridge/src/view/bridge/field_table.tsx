import type { ComponentChildren } from 'preact';
import type { Selection } from '../../state/selection';
import { t } from '../../text';
import { ColumnHeads } from '../shared/column_heads';
import { moveWithArrows } from '../shared/roving';
import { FieldButton } from './field_button';

/** The fields of a message, of either side: `FieldRow`s. */
export function FieldTable({ children }: { children: ComponentChildren }) {
  return (
    <table class="fields" onKeyDown={moveWithArrows}>
      <caption>{t('pane.fields')}</caption>
      <ColumnHeads titles={[t('pane.field'), t('pane.hex'), t('pane.raw'), t('pane.value')]} />
      <tbody>{children}</tbody>
    </table>
  );
}

export function FieldRow(props: {
  target: Selection;
  name: string;
  aside: string | undefined;
  isFirst: boolean;
  isMarked: boolean;
  isAbsent: boolean;
  hex: string | undefined; // nothing: `missing` tells why there are no bytes
  missing: string;
  raw: ComponentChildren;
  value: ComponentChildren;
}) {
  const { target, name, aside, isFirst, isMarked, isAbsent, hex, missing, raw, value } = props;
  return (
    <tr class={`${isMarked ? 'marked' : ''} ${isAbsent ? 'absent' : ''}`}>
      <th scope="row">
        <FieldButton target={target} isFirst={isFirst} isMarked={isMarked}>
          {name}
        </FieldButton>
        {aside && <span class="muted aside">{aside}</span>}
      </th>
      <td class="code">{hex ?? <i>{missing}</i>}</td>
      <td class="number">{raw}</td>
      <td class="number">{value}</td>
    </tr>
  );
}
