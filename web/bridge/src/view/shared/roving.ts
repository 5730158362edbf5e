/**
 * Lets the arrow keys move the focus among the elements with `data-roving` inside the element that has this handler, so
 * that a long list is one stop for Tab.
 */
export function moveWithArrows(event: KeyboardEvent): void {
  const step = { ArrowDown: 1, ArrowRight: 1, ArrowUp: -1, ArrowLeft: -1 }[event.key];
  if (step === undefined || !(event.currentTarget instanceof Element) || !(event.target instanceof HTMLElement)) return;
  const items = [...event.currentTarget.querySelectorAll<HTMLElement>('[data-roving]')];
  const from = items.indexOf(event.target);
  if (from < 0) return;
  event.preventDefault();
  items[(from + step + items.length) % items.length]!.focus();
}
