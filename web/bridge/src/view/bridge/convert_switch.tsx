import { mayCommand, toggleConversion } from '../../state/actions';
import { status } from '../../state/store';
import { t } from '../../text';

export function ConvertSwitch() {
  const isOn = status.value?.conversion ?? false;
  return (
    <button
      type="button"
      role="switch"
      class="switch"
      aria-checked={isOn}
      aria-keyshortcuts="c"
      disabled={!mayCommand()}
      onClick={toggleConversion}
    >
      <span class="knob" aria-hidden="true" /> {t('convert.label')}: {t(isOn ? 'convert.on' : 'convert.off')}
    </button>
  );
}
