import { signal } from '@preact/signals';
import { api } from '../client/api';
import type { Flow } from '../model/crossings';
import { unitSystems } from '../model/units';
import { languages, type TextKey } from '../text';
import { chosenFlow } from './selection';
import { next, settings, themes } from './settings';
import { act, catalogue, chosenVehicle, live, paused, role, status, vehicleId, view, type View } from './store';

export const helpIsOpen = signal(false);

export const mayCommand = () => role.value === 'command';

export function toggleConversion(): void {
  if (mayCommand() && status.value) void act(api.convert(!status.value.conversion));
}

/** The flow that the panes show, if anything has crossed. */
export function shownFlow() {
  return live.crossings.flow(chosenFlow.value ?? '') ?? live.crossings.flows()[0];
}

/**
 * The DLI messages that a flow becomes: those that it has become, without what only happened to be sent at the same
 * moment; while there are none, those that carry its values.
 */
export function numbersOf({ crossing: { mavlink }, numbers }: Flow): number[] {
  const mapped = (mavlink && catalogue.value?.numbersFrom(mavlink.name)) ?? [];
  const own = numbers.filter((number) => mapped.includes(number));
  if (own.length > 0) return own;
  return numbers.length > 0 ? numbers : mapped;
}

function moveFlow(step: 1 | -1): void {
  const flows = live.crossings.flows();
  if (flows.length === 0) return;
  const index = flows.findIndex(({ key }) => key === shownFlow()?.key);
  chosenFlow.value = flows[(index + step + flows.length) % flows.length]!.key;
}

function nextVehicle(): void {
  const ids = (status.value?.vehicles ?? []).map(({ id }) => id);
  if (vehicleId.value !== undefined) chosenVehicle.value = next(ids, vehicleId.value);
}

function show(which: View): void {
  view.value = which;
}

/** What single keys do; the help lists them in this order. */
export const actions: readonly { key: string; text: TextKey; run: () => void }[] = [
  { key: '1', text: 'key.bridge', run: () => show('bridge') },
  { key: '2', text: 'key.inspector', run: () => show('inspector') },
  { key: '3', text: 'key.timing', run: () => show('timing') },
  { key: '4', text: 'key.links', run: () => show('links') },
  { key: 'p', text: 'key.pause', run: () => (paused.value = !paused.value) },
  { key: 'c', text: 'key.convert', run: toggleConversion },
  { key: 'v', text: 'key.vehicle', run: nextVehicle },
  { key: 'n', text: 'key.flow', run: () => moveFlow(1) },
  { key: 'b', text: 'key.flowBack', run: () => moveFlow(-1) },
  { key: '/', text: 'key.filter', run: focusFilter },
  { key: 'u', text: 'key.units', run: () => (settings.units.value = next(unitSystems, settings.units.value)) },
  { key: 't', text: 'key.theme', run: () => (settings.theme.value = next(themes, settings.theme.value)) },
  { key: 'l', text: 'key.language', run: () => (settings.language.value = next(languages, settings.language.value)) },
  { key: '?', text: 'key.help', run: () => (helpIsOpen.value = true) },
];

export const filterId = 'inspector-filter';

function focusFilter(): void {
  show('inspector');
  // The view is drawn first.
  requestAnimationFrame(() => document.getElementById(filterId)?.focus());
}

/** Runs the action of a key, unless the key is meant for a text or a choice that has the focus. */
export function onKey(event: KeyboardEvent): void {
  if (event.ctrlKey || event.altKey || event.metaKey || helpIsOpen.value) return;
  if (settings.keys.value === 'off' && event.key !== '?') return;
  if (event.target instanceof Element && event.target.matches('input, select, textarea')) return;
  const action = actions.find(({ key }) => key === event.key);
  if (action === undefined) return;
  event.preventDefault();
  action.run();
}
