import { useSignal } from '@preact/signals';
import type { ComponentChildren } from 'preact';
import { timeText } from '../../model/format';
import { t } from '../../text';
import { ColumnHeads } from '../shared/column_heads';
import { moveWithArrows } from '../shared/roving';

/** One line of an inspector table, which can be opened. */
export interface Line {
  key: string;
  title: string;
  from: string;
  count: number;
  rate_hz: number;
  time_ms: number;
  details: () => ComponentChildren;
}

/** Messages with their counts and rates; each opens to show what it says. */
export function MessageTable({ fromTitle, lines }: { fromTitle: string; lines: Line[] }) {
  const open = useSignal<ReadonlySet<string>>(new Set());
  if (lines.length === 0) return <p class="muted">{t('inspector.none')}</p>;
  const toggle = (key: string) => {
    const changed = new Set(open.value);
    if (!changed.delete(key)) changed.add(key);
    open.value = changed;
  };
  return (
    <div class="scroll">
      <table class="messages" onKeyDown={moveWithArrows}>
        <ColumnHeads
          titles={[t('inspector.message'), fromTitle, t('inspector.count'), t('inspector.rate'), t('inspector.time')]}
        />
        <tbody>
          {lines.map((line, index) => (
            <Row
              key={line.key}
              line={line}
              isFirst={index === 0}
              isOpen={open.value.has(line.key)}
              onToggle={() => toggle(line.key)}
            />
          ))}
        </tbody>
      </table>
    </div>
  );
}

function Row(props: { line: Line; isFirst: boolean; isOpen: boolean; onToggle: () => void }) {
  const { line, isOpen } = props;
  return (
    <>
      <tr>
        <th scope="row">
          <button
            type="button"
            class="opener"
            data-roving
            tabIndex={props.isFirst || isOpen ? 0 : -1}
            aria-expanded={isOpen}
            onClick={props.onToggle}
          >
            <span aria-hidden="true">{isOpen ? '▾' : '▸'} </span>
            {line.title}
          </button>
        </th>
        <td class="code">{line.from}</td>
        <td class="number">{line.count}</td>
        <td class="number">{line.rate_hz.toFixed(1)}</td>
        <td class="number">{timeText(line.time_ms)}</td>
      </tr>
      {isOpen && (
        <tr class="details">
          <td colSpan={5}>
            <p class="muted narrow-only">
              {t('inspector.time')} <span class="number">{timeText(line.time_ms)}</span>
            </p>
            {line.details()}
          </td>
        </tr>
      )}
    </>
  );
}
