import { unitSystems } from '../model/units';
import { actions, helpIsOpen } from '../state/actions';
import { settings, themes } from '../state/settings';
import { connection, needsToken, view, views } from '../state/store';
import { languageNames, languages, t } from '../text';
import { Choice } from './shared/choice';

const connectionSigns = { connecting: '◌', live: '●', lost: '▲' } as const;

export function PageHeader() {
  return (
    <header class="page-header">
      <div class="brand">
        <img src="/favicon.svg" alt="" width="28" height="28" />
        <h1>Ponte</h1>
        <Connection />
      </div>
      <nav aria-label={t('nav.label')}>
        {views.map((name, index) => (
          <button
            key={name}
            type="button"
            aria-current={view.value === name ? 'page' : undefined}
            aria-keyshortcuts={actions[index]!.key}
            onClick={() => (view.value = name)}
          >
            {t(`nav.${name}`)}
          </button>
        ))}
      </nav>
      <div class="appearance" role="group" aria-label={t('settings.label')}>
        <Choice
          label={t('settings.units')}
          setting={settings.units}
          options={unitSystems.map((system) => [system, t(`units.${system}`)])}
        />
        <Choice
          label={t('settings.theme')}
          setting={settings.theme}
          options={themes.map((theme) => [theme, t(`theme.${theme}`)])}
        />
        <Choice
          label={t('settings.language')}
          setting={settings.language}
          options={languages.map((language) => [language, languageNames[language]])}
        />
        <button
          type="button"
          class="round"
          aria-label={t('key.help')}
          aria-keyshortcuts="?"
          onClick={() => (helpIsOpen.value = true)}
        >
          ?
        </button>
      </div>
    </header>
  );
}

function Connection() {
  const state = connection.value;
  return (
    <span class={`connection ${state}`} role="status">
      <span aria-hidden="true">{connectionSigns[state]} </span>
      {needsToken.value ? t('connection.signin') : t(`connection.${state}`)}
    </span>
  );
}
