import type { Event } from '../../contract';
import { timeText } from '../../model/format';
import { events } from '../../state/store';
import { t } from '../../text';
import { Panel } from '../shared/panel';

const signs: Record<Event['severity'], string> = { info: '○', warning: '▲', error: '✖' };
const shownAtMost = 200;

/** What happened, newest first. */
export function EventLog() {
  const newestFirst = events.value.slice(-shownAtMost).reverse();
  return (
    <Panel title={t('events.title')}>
      {newestFirst.length === 0 && <p class="muted">{t('events.none')}</p>}
      <ol class="events">
        {newestFirst.map(({ number, time_ms, code, severity, vehicle, text }) => (
          <li key={number} class={severity}>
            <span class="number">{timeText(time_ms)}</span>
            <span aria-hidden="true">{signs[severity]}</span>
            <span class="unseen">{t(`severity.${severity}`)}</span>
            <b>{t(`event.${code}`)}</b>
            <span>
              {text} {vehicle && <span class="code muted">{vehicle}</span>}
            </span>
          </li>
        ))}
      </ol>
    </Panel>
  );
}
