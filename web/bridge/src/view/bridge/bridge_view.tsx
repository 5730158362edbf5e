import { useSignal } from '@preact/signals';
import { useEffect } from 'preact/hooks';
import type { Flow } from '../../model/crossings';
import { numbersOf, shownFlow } from '../../state/actions';
import { selectFirstMapped } from '../../state/selection';
import { catalogue, live, paused, reading, status } from '../../state/store';
import { t, type TextKey } from '../../text';
import { Panel } from '../shared/panel';
import { SideName } from '../shared/side';
import { DliPane } from './dli_pane';
import { FlowBar } from './flow_bar';
import { Hero } from './hero';
import { Instruments } from './instruments';
import { MavlinkPane } from './mavlink_pane';
import { RulePane } from './rule_pane';
import { StageStrip } from './stage_strip';
import { VehicleBar } from './vehicle_bar';

/** The same event on both sides, and how it gets across. */
export function BridgeView() {
  return (
    <>
      <Hero />
      <VehicleBar />
      <Instruments />
      <FlowBar />
      {paused.value && <p class="note">{t('pause.paused')}</p>}
      <Sides />
    </>
  );
}

function Sides() {
  void reading.value;
  const flow = shownFlow();
  useEffect(() => selectFirstMapped(flow?.crossing.mavlink), [flow?.key, catalogue.value]);
  if (flow === undefined) return null;
  const { mavlink } = flow.crossing;
  return (
    <div class="sides">
      <Panel class="mavlink-side" title={<SideName side="mavlink" />}>
        {mavlink ? <MavlinkPane message={mavlink} /> : <p>{t('pane.clock')}</p>}
      </Panel>
      <Panel class="rule-side" title={t('rule.title')}>
        <RulePane />
        <StageStrip crossing={flow.crossing} />
      </Panel>
      <Panel class="dli-side" title={<SideName side="dli" />}>
        <Translated key={flow.key} flow={flow} />
      </Panel>
    </div>
  );
}

/** The DLI messages that belong to a flow; where there are several, one at a time. */
function Translated({ flow }: { flow: Flow }) {
  const chosen = useSignal<number | undefined>(undefined);
  const numbers = numbersOf(flow);
  const number = numbers.find((candidate) => candidate === chosen.value) ?? numbers[0];
  if (number === undefined) return <p>{t('pane.untranslated')}</p>;
  const own = flow.crossing.dli.find((message) => message.number === number);
  const message = own ?? live.crossings.newestDli(number);
  return (
    <>
      {numbers.length > 1 && (
        <p class="chips">
          {numbers.map((candidate) => (
            <button
              key={candidate}
              type="button"
              class="chip"
              aria-pressed={candidate === number}
              onClick={() => (chosen.value = candidate)}
            >
              #{candidate}
            </button>
          ))}
        </p>
      )}
      {!own && <p class="note">{t(reasonOfAbsence(flow))}</p>}
      {message ? <DliPane message={message} /> : <p>{t('pane.waiting')}</p>}
    </>
  );
}

function reasonOfAbsence({ numbers }: Flow): TextKey {
  if (status.value?.conversion === false) return 'pane.off';
  return numbers.length > 0 ? 'pane.noNews' : 'pane.carried';
}
