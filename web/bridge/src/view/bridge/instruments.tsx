import { fixed, shownText } from '../../model/format';
import { instrumentKeys, instruments, type InstrumentKey, type Reading } from '../../model/instruments';
import { degrees, shown } from '../../model/units';
import { settings } from '../../state/settings';
import { live, motion, reading } from '../../state/store';
import { t } from '../../text';
import { Panel } from '../shared/panel';
import { SideSign } from '../shared/side';
import { AttitudeIndicator } from './attitude_indicator';
import { HeadingRose } from './heading_rose';
import { Tape } from './tape';

/** What both sides say of the same quantities: MAVLink as a solid needle, the DLI as a hollow one over it. */
export function Instruments() {
  return (
    <Panel class="instruments" title={t('instruments.label')}>
      <div class="dials">
        <Dials />
      </div>
      <Numbers />
    </Panel>
  );
}

function Dials() {
  void motion.value;
  const { roll, pitch, heading, altitude, speed, battery } = live.crossings.readings();
  const system = settings.units.value;
  const length = (value: number) => shown('length', value, system);
  const velocity = (value: number) => shown('speed', value, system);
  const percent = (value: number) => ({ value, unit: '%' });
  return (
    <>
      <AttitudeIndicator roll={roll} pitch={pitch} />
      <HeadingRose heading={heading} />
      <Tape label={t('instruments.speed')} reading={speed} scale={velocity} step={system === 'si' ? 5 : 10} />
      <Tape
        label={t('instruments.altitude')}
        reading={altitude}
        scale={length}
        step={system === 'aviation' ? 100 : 20}
      />
      <Tape label={t('instruments.battery')} reading={battery} scale={percent} step={20} />
    </>
  );
}

function Numbers() {
  void reading.value;
  const readings = live.crossings.readings();
  return (
    <table class="instrument-numbers">
      <thead>
        <tr>
          <th scope="col">{t('instruments.quantity')}</th>
          <th scope="col">
            <SideSign side="mavlink" /> MAVLink
          </th>
          <th scope="col">
            <SideSign side="dli" /> STANAG 4586
          </th>
          <th scope="col">{t('instruments.verdict')}</th>
        </tr>
      </thead>
      <tbody>
        {instrumentKeys.map((key) => (
          <tr key={key} data-instrument={key}>
            <th scope="row">{t(`instruments.${key}`)}</th>
            <td class="number">{textOf(key, readings[key].mavlink)}</td>
            <td class="number">{textOf(key, readings[key].dli)}</td>
            <td>
              <Verdict reading={readings[key]} />
            </td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}

function Verdict({ reading: { agrees } }: { reading: Reading }) {
  if (agrees === undefined) return <span class="muted">… {t('instruments.waiting')}</span>;
  return agrees ? (
    <span class="good">✓ {t('instruments.agree')}</span>
  ) : (
    <strong class="bad">≠ {t('instruments.differ')}</strong>
  );
}

function textOf(key: InstrumentKey, value: number | undefined): string {
  if (value === undefined) return '–';
  const { quantity } = instruments[key];
  if (quantity === 'percent') return `${fixed(value, 0)}\u00a0%`;
  if (key === 'heading') return `${fixed((degrees(value) + 360) % 360, 2)}°`;
  if (quantity === 'angle') return `${fixed(degrees(value), 2)}°`;
  return shownText(shown(quantity, value, settings.units.value));
}
