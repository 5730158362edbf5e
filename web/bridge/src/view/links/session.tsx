import { hasSession, role, signOut } from '../../state/store';
import { t } from '../../text';
import { Panel } from '../shared/panel';
import { SignInForm } from './sign_in';

/** What this browser may do. */
export function Session() {
  const own = role.value;
  if (own === undefined) return null;
  return (
    <Panel title={t('session.title')}>
      <p>
        {own === 'command' ? '✓ ' : '◌ '}
        {t(`session.${own}`)}
      </p>
      {own === 'watch' && <SignInForm />}
      {hasSession.value && (
        <button type="button" onClick={() => void signOut()}>
          {t('session.signout')}
        </button>
      )}
    </Panel>
  );
}
