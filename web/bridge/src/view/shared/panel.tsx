import type { ComponentChildren } from 'preact';
import { useId } from 'preact/hooks';

/** A titled part of a view. */
export function Panel(props: { title: ComponentChildren; class?: string; children: ComponentChildren }) {
  const id = useId();
  return (
    <section class={`panel ${props.class ?? ''}`} aria-labelledby={id}>
      <h2 id={id}>{props.title}</h2>
      {props.children}
    </section>
  );
}
