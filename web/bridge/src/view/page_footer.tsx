import { timeText } from '../model/format';
import { dropped, events, status, version } from '../state/store';
import { t } from '../text';

/** The newest event, and what a person should know about the data on the page. */
export function PageFooter() {
  const newest = events.value.at(-1);
  return (
    <footer class="page-footer">
      <p role="status">
        {newest && (
          <>
            <span class="number">{timeText(newest.time_ms)}</span> {t(`event.${newest.code}`)}: {newest.text}
          </>
        )}
      </p>
      {dropped.value > 0 && (
        <p class="warning">
          ▲ {dropped.value} {t('events.dropped')}
        </p>
      )}
      <p class="muted">
        ponte {version.value}
        {status.value && ` · STANAG 4586 Ed. ${status.value.edition} · ${status.value.profile}`}
      </p>
    </footer>
  );
}
