import { shownFlow } from '../../state/actions';
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
      {flows.map(({ key, title, crossing, numbers }) => (
        <button
          key={key}
          type="button"
          class="chip"
          data-roving
          tabIndex={key === shown ? 0 : -1}
          aria-pressed={key === shown}
          onClick={() => (chosenFlow.value = key)}
        >
          {key === shown && <span aria-hidden="true">✓ </span>}
          {title}
          {crossing.mavlink && numbers.length > 0 && (
            <>
              <span aria-hidden="true"> → </span>
              <span class="unseen"> {t('flows.becomes')} </span>
              <span class="dli-ink">{numbers.map((number) => `#${number}`).join(' ')}</span>
            </>
          )}
        </button>
      ))}
    </div>
  );
}
