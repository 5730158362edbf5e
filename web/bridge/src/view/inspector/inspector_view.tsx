import { signal } from '@preact/signals';
import { filterId } from '../../state/actions';
import { live, reading } from '../../state/store';
import { t } from '../../text';
import { Panel } from '../shared/panel';
import { PauseButton } from '../shared/pause_button';
import { SideName } from '../shared/side';
import { DliTable } from './dli_table';
import { Losses } from './losses';
import { MavlinkTable } from './mavlink_table';
import { Plots } from './plots';
import { Rejects } from './rejects';

const filter = signal('');

/** Everything that was heard and said: the last value of each message, rates, losses, and what was rejected. */
export function InspectorView() {
  void reading.value;
  const { traffic } = live;
  return (
    <>
      <div class="toolbar">
        <PauseButton />
        <label class="grow">
          <span>{t('inspector.filter')}</span>
          <input
            id={filterId}
            type="search"
            placeholder={t('inspector.filter.hint')}
            value={filter.value}
            onInput={(event) => (filter.value = event.currentTarget.value)}
          />
        </label>
      </div>
      <Plots />
      <Panel title={<SideName side="mavlink" />}>
        <MavlinkTable rows={traffic.mavlink(filter.value)} />
      </Panel>
      <Panel title={<SideName side="dli" />}>
        <DliTable rows={traffic.dli(filter.value)} />
      </Panel>
      <div class="halves">
        <Panel title={t('inspector.losses')}>
          <Losses senders={traffic.senders()} />
        </Panel>
        <Panel title={t('inspector.rejects')}>
          <Rejects rejects={traffic.rejects()} />
        </Panel>
      </div>
    </>
  );
}
