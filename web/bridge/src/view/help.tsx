import { useEffect, useRef } from 'preact/hooks';
import { actions, helpIsOpen } from '../state/actions';
import { settings } from '../state/settings';
import { t } from '../text';

/** Which key does what. The browser's own dialog keeps the focus inside and closes with Escape. */
export function Help() {
  const dialog = useRef<HTMLDialogElement>(null);
  const isOpen = helpIsOpen.value;
  useEffect(() => {
    if (isOpen) dialog.current?.showModal();
    else dialog.current?.close();
  }, [isOpen]);
  return (
    <dialog ref={dialog} class="help" aria-labelledby="help-title" onClose={() => (helpIsOpen.value = false)}>
      <h2 id="help-title">{t('help.title')}</h2>
      <dl>
        {actions.map(({ key, text }) => (
          <div key={key}>
            <dt>
              <kbd>{key}</kbd>
            </dt>
            <dd>{t(text)}</dd>
          </div>
        ))}
      </dl>
      <p>{t('help.moving')}</p>
      <label>
        <input
          type="checkbox"
          checked={settings.keys.value === 'on'}
          onChange={(event) => (settings.keys.value = event.currentTarget.checked ? 'on' : 'off')}
        />{' '}
        {t('help.enabled')}
      </label>
      <form method="dialog">
        <button>{t('help.close')}</button>
      </form>
    </dialog>
  );
}
