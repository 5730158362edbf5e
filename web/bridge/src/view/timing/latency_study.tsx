import { useSignal } from '@preact/signals';
import { useEffect } from 'preact/hooks';
import { api, studyAddress } from '../../client/api';
import type { StudyResult } from '../../contract';
import { mayCommand } from '../../state/actions';
import { act, study } from '../../state/store';
import { t } from '../../text';
import { Panel } from '../shared/panel';
import { StudyView } from './study_view';

const usualSamples = 30;
const formats = ['json', 'csv', 'html'] as const;

/** Starts the latency study, shows how far it is, and what came out. */
export function LatencyStudy() {
  const result = useSignal<StudyResult | undefined>(undefined);
  const now = study.value;
  const state = now?.state ?? 'none';
  useEffect(() => {
    if (state === 'done') void act(api.studyResult()).then((loaded) => (result.value = loaded));
  }, [state]);
  return (
    <Panel title={t('study.title')}>
      <p>{t('study.explain')}</p>
      <StudyForm isRunning={state === 'running'} />
      {now && state === 'running' && (
        <p>
          <progress value={now.done} max={now.samples} aria-label={t('study.progress')} />{' '}
          <span class="number">
            {now.done} / {now.samples}
          </span>{' '}
          {t('study.progress')}
        </p>
      )}
      {state === 'failed' && (
        <p class="problem">
          ✖ {t('study.failed')} {now?.detail}
        </p>
      )}
      {state === 'done' && result.value && (
        <>
          <StudyView result={result.value} />
          <p>
            {t('study.download')}:{' '}
            {formats.map((format) => (
              <a key={format} class="download" href={studyAddress(format)} download={`ponte-latency.${format}`}>
                {format.toUpperCase()}
              </a>
            ))}
          </p>
        </>
      )}
    </Panel>
  );
}

function StudyForm({ isRunning }: { isRunning: boolean }) {
  const samples = useSignal(usualSamples);
  const limit_ms = useSignal(500);
  return (
    <form
      class="toolbar"
      onSubmit={(event) => {
        event.preventDefault();
        void act(isRunning ? api.stopStudy() : api.startStudy(samples.value, limit_ms.value));
      }}
    >
      <label>
        <span>{t('study.samples')}</span>
        <input
          type="number"
          required
          min={2}
          max={10000}
          value={samples.value}
          disabled={isRunning}
          onInput={(event) => (samples.value = event.currentTarget.valueAsNumber)}
        />
      </label>
      <label>
        <span>{t('study.limit')}</span>
        <input
          type="number"
          required
          step="any"
          min={1}
          max={60000}
          value={limit_ms.value}
          disabled={isRunning}
          onInput={(event) => (limit_ms.value = event.currentTarget.valueAsNumber)}
        />
      </label>
      <button type="submit" class="primary" disabled={!mayCommand()}>
        {t(isRunning ? 'study.stop' : 'study.run')}
      </button>
    </form>
  );
}
