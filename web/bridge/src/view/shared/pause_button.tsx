import { paused } from '../../state/store';
import { t } from '../../text';

/** Lets the values stand still to be read. */
export function PauseButton() {
  return (
    <button
      type="button"
      class="pause"
      aria-pressed={paused.value}
      aria-keyshortcuts="p"
      onClick={() => (paused.value = !paused.value)}
    >
      <span aria-hidden="true">{paused.value ? '▶' : '❚❚'} </span>
      {t(paused.value ? 'pause.resume' : 'pause.pause')}
    </button>
  );
}
