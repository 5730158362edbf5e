import type { Reject } from '../../contract';
import { t } from '../../text';
import { SideName } from '../shared/side';

/** What was received and is no good message, by reason. */
export function Rejects({ rejects }: { rejects: Reject[] }) {
  if (rejects.length === 0) return <p class="muted">{t('links.none')}</p>;
  return (
    <div class="scroll">
      <table>
        <thead>
          <tr>
            <th scope="col">{t('inspector.side')}</th>
            <th scope="col">{t('inspector.reason')}</th>
            <th scope="col">{t('inspector.count')}</th>
            <th scope="col">{t('inspector.bytes')}</th>
          </tr>
        </thead>
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
