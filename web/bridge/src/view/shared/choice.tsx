import type { Signal } from '@preact/signals';

/** A drop-down list that sets a signal. */
export function Choice<T extends string>(props: {
  label: string;
  setting: Signal<T>;
  options: readonly (readonly [T, string])[];
}) {
  return (
    <label class="choice">
      <span>{props.label}</span>
      <select value={props.setting.value} onChange={(event) => (props.setting.value = event.currentTarget.value as T)}>
        {props.options.map(([value, text]) => (
          <option key={value} value={value}>
            {text}
          </option>
        ))}
      </select>
    </label>
  );
}
