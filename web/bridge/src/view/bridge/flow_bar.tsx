import type { Flow } from '../../model/crossings';
import { numbersOf, shownFlow } from '../../state/actions';
import { chosenFlow } from '../../state/selection';
import { live, reading } from '../../state/store';
import { t } from '../../text';
import { moveWithArrows } from '../shared/roving';
import { PauseButton } from '../shared/pause_button';

/** What crosses, one of which the panes show. */
export function FlowBar() {
  void reading.value;
  const flows = live.crossings.flows();
  const shown = shownFlow()?.key;
  return (
    <div class="chips" role="group" aria-label={t('flows.label')} onKeyDown={moveWithArrows}>
      <PauseButton />
      {flows.length === 0 && <span class="muted">{t('flows.none')}</span>}
      {flows.map((flow) => (
        <FlowChip key={flow.key} flow={flow} isShown={flow.key === shown} />
      ))}
    </div>
  );
}

function FlowChip({ flow, isShown }: { flow: Flow; isShown: boolean }) {
  const becomes = flow.crossing.mavlink && flow.numbers.length > 0 ? numbersOf(flow) : [];
  return (
    <button
      type="button"
      class="chip"
      data-roving
      tabIndex={isShown ? 0 : -1}
      aria-pressed={isShown}
      onClick={() => (chosenFlow.value = flow.key)}
    >
      {isShown && <span aria-hidden="true">✓ </span>}
      {flow.title}
      {becomes.length > 0 && (
        <>
          <span aria-hidden="true"> → </span>
          <span class="unseen"> {t('flows.becomes')} </span>
          <span class="dli-ink">{becomes.map((number) => `#${number}`).join(' ')}</span>
        </>
      )}
    </button>
  );
}
