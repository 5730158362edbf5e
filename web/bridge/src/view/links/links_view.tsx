import type { VehicleLink } from '../../contract';
import { api } from '../../client/api';
import { mayCommand } from '../../state/actions';
import { act, status } from '../../state/store';
import { t } from '../../text';
import { Panel } from '../shared/panel';
import { ConnectForm } from './connect_form';
import { EventLog } from './event_log';
import { Session } from './session';

/** Where vehicles and ground stations are, and what happened. */
export function LinksView() {
  const now = status.value;
  return (
    <>
      <Panel title={t('links.vehicles')}>
        <ul class="links">
          {now?.vehicle_links.map((link) => (
            <LinkItem key={link.number} link={link} />
          ))}
          {now?.vehicle_links.length === 0 && <li class="muted">{t('links.none')}</li>}
        </ul>
        <ConnectForm />
      </Panel>
      <div class="halves">
        <Panel title={t('links.dli')}>
          <ul class="links">
            {now?.dli_links.map((endpoint) => (
              <li key={endpoint} class="code">
                {endpoint}
              </li>
            ))}
            {now?.dli_links.length === 0 && <li class="muted">{t('links.none')}</li>}
          </ul>
          <p>
            {t('links.edition')}: {now?.edition}, {now?.profile}
          </p>
        </Panel>
        <Session />
      </div>
      <EventLog />
    </>
  );
}

function LinkItem({ link: { number, endpoint, state, detail } }: { link: VehicleLink }) {
  return (
    <li>
      <span class={state === 'up' ? 'good' : 'warning'}>
        {state === 'up' ? '●' : '◌'} {t(`links.${state}`)}
      </span>
      <span>
        <b>{number}</b> <span class="code">{endpoint}</span> <span class="muted">{detail}</span>
      </span>
      <button
        type="button"
        disabled={!mayCommand()}
        aria-label={`${t('links.disconnect')}: ${endpoint}`}
        onClick={() => void act(api.disconnect(number))}
      >
        {t('links.disconnect')}
      </button>
    </li>
  );
}
