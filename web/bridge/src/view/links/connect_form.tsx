import { useSignal, type Signal } from '@preact/signals';
import { useEffect } from 'preact/hooks';
import { api } from '../../client/api';
import type { Port } from '../../contract';
import { baudRates, serialEndpoint } from '../../model/endpoint';
import { mayCommand } from '../../state/actions';
import { act } from '../../state/store';
import { t } from '../../text';

const usualBaud = 57600;

/** Connects to a serial port and baud rate, or to any endpoint as text. Choosing a port writes the text. */
export function ConnectForm() {
  const ports = useSignal<Port[]>([]);
  const device = useSignal('');
  const baud = useSignal(usualBaud);
  const endpoint = useSignal('');
  const look = async () => (ports.value = (await act(api.ports())) ?? []);
  useEffect(() => void look(), []);
  const compose = () => {
    if (device.value !== '') endpoint.value = serialEndpoint(device.value, baud.value);
  };
  return (
    <form
      class="toolbar"
      onSubmit={(event) => {
        event.preventDefault();
        void act(api.connect(endpoint.value.trim()));
      }}
    >
      <PortChoice ports={ports.value} device={device} onChange={compose} />
      <button type="button" aria-label={`${t('links.serial')}: ${t('links.refresh')}`} onClick={() => void look()}>
        ↻
      </button>
      <label>
        <span>{t('links.baud')}</span>
        <select
          value={baud.value}
          onChange={(event) => {
            baud.value = Number(event.currentTarget.value);
            compose();
          }}
        >
          {baudRates.map((rate) => (
            <option key={rate} value={rate}>
              {rate}
            </option>
          ))}
        </select>
      </label>
      <label class="grow">
        <span>{t('links.endpoint')}</span>
        <input
          type="text"
          class="code"
          required
          maxLength={256}
          placeholder="udpin://0.0.0.0:14550"
          value={endpoint.value}
          onInput={(event) => (endpoint.value = event.currentTarget.value)}
        />
      </label>
      <button type="submit" class="primary" disabled={!mayCommand()}>
        {t('links.connect')}
      </button>
    </form>
  );
}

function PortChoice(props: { ports: Port[]; device: Signal<string>; onChange: () => void }) {
  return (
    <label>
      <span>{t('links.serial')}</span>
      <select
        value={props.device.value}
        onChange={(event) => {
          props.device.value = event.currentTarget.value;
          props.onChange();
        }}
      >
        <option value="">{props.ports.length === 0 ? t('links.noPorts') : '–'}</option>
        {props.ports.map(({ device, autopilot }) => (
          <option key={device} value={device}>
            {device}
            {autopilot && ` (${t('links.autopilot')})`}
          </option>
        ))}
      </select>
    </label>
  );
}
