import { hexOf, type HeaderField } from '../../model/bytes';
import { t } from '../../text';
import { ColumnHeads } from './column_heads';

/** The pieces of a header with their bytes in hexadecimal and their value in decimal. */
export function HeaderTable(props: { title: string; bytes: Uint8Array; fields: HeaderField[] }) {
  return (
    <details open>
      <summary>{props.title}</summary>
      <table class="header-table">
        <ColumnHeads titles={[t('pane.field'), t('pane.hex'), t('pane.decimal')]} />
        <tbody>
          {props.fields.map(({ name, range, value }) => (
            <tr key={name}>
              <th scope="row">{name}</th>
              <td class="code">{hexOf(props.bytes, range)}</td>
              <td class="number">{value}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </details>
  );
}
