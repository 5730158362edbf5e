import { selection, type Selection } from '../../state/selection';

/** A field's name; pointing at it or giving it the focus selects it. */
export function FieldButton(props: { target: Selection; isFirst: boolean; isMarked: boolean; children: string }) {
  const choose = () => (selection.value = props.target);
  const isSelected = same(selection.value, props.target);
  const isStop = isSelected || (props.isFirst && selection.value?.side !== props.target.side);
  return (
    <button
      type="button"
      class="field-button"
      data-roving
      tabIndex={isStop ? 0 : -1}
      aria-pressed={isSelected}
      onFocus={choose}
      onMouseEnter={choose}
      onClick={choose}
    >
      <span aria-hidden="true">{props.isMarked ? '▸' : '\u2007'}</span>
      {props.children}
    </button>
  );
}

function same(a: Selection | undefined, b: Selection): boolean {
  return JSON.stringify(a) === JSON.stringify(b);
}
