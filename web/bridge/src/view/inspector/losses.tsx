import type { Sender } from '../../contract';
import { t } from '../../text';

/** What the sequence numbers of each sender tell. */
export function Losses({ senders }: { senders: Sender[] }) {
  return (
    <div class="scroll">
      <table>
        <thead>
          <tr>
            <th scope="col">{t('inspector.from')}</th>
            <th scope="col">{t('inspector.received')}</th>
            <th scope="col">{t('inspector.lost')}</th>
            <th scope="col">{t('inspector.late')}</th>
            <th scope="col">{t('inspector.duplicates')}</th>
          </tr>
        </thead>
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
