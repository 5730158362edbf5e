import type { Sender } from '../../contract';
import { t } from '../../text';
import { ColumnHeads } from '../shared/column_heads';

/** What the sequence numbers of each sender tell. */
export function Losses({ senders }: { senders: Sender[] }) {
  return (
    <div class="scroll">
      <table>
        <ColumnHeads
          titles={[
            t('inspector.from'),
            t('inspector.received'),
            t('inspector.lost'),
            t('inspector.late'),
            t('inspector.duplicates'),
          ]}
        />
        <tbody>
          {senders.map(({ link, system, component, received, lost, late, duplicates }) => (
            <tr key={`${link}.${system}.${component}`}>
              <th scope="row" class="code">
                {link}/{system}/{component}
              </th>
              <td class="number">{received}</td>
              <td class="number">
                {lost > 0 && '▲ '}
                {lost} ({((100 * lost) / (received + lost)).toFixed(1)} %)
              </td>
              <td class="number">{late}</td>
              <td class="number">{duplicates}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}
