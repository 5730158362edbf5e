import type { Reject } from '../../contract';
import { t } from '../../text';
import { ColumnHeads } from '../shared/column_heads';
import { SideName } from '../shared/side';

/** What was received and is no good message, by reason. */
export function Rejects({ rejects }: { rejects: Reject[] }) {
  if (rejects.length === 0) return <p class="muted">{t('links.none')}</p>;
  return (
    <div class="scroll">
      <table>
        <ColumnHeads
          titles={[t('inspector.side'), t('inspector.reason'), t('inspector.count'), t('inspector.bytes')]}
        />
        <tbody>
          {rejects.map(({ side, link, reason, count, bytes }) => (
            <tr key={`${side}.${link}.${reason}`}>
              <td>
                <SideName side={side} /> {link}
              </td>
              <td>{reason}</td>
              <td class="number">{count}</td>
              <td class="number">{bytes}</td>
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}
