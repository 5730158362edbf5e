import { useSignal } from '@preact/signals';
import { signIn } from '../../state/store';
import { t } from '../../text';
import { Panel } from '../shared/panel';

/** Stands in the place of a view while the server does not know this browser. */
export function SignIn() {
  return (
    <Panel title={t('session.title')}>
      <p>{t('session.needed')}</p>
      <SignInForm />
    </Panel>
  );
}

export function SignInForm() {
  const token = useSignal('');
  return (
    <form
      class="toolbar"
      onSubmit={(event) => {
        event.preventDefault();
        void signIn(token.value.trim());
      }}
    >
      <label class="grow">
        <span>{t('session.token')}</span>
        <input
          type="password"
          required
          autocomplete="off"
          maxLength={128}
          value={token.value}
          onInput={(event) => (token.value = event.currentTarget.value)}
        />
      </label>
      <button type="submit" class="primary">
        {t('session.signin')}
      </button>
    </form>
  );
}
