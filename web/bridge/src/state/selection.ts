import { computed, signal } from '@preact/signals';
import type { MavlinkMessage } from '../contract';
import { catalogue } from './store';

/** The field that is pointed at. */
export type Selection =
  { side: 'mavlink'; message: string; field: string } | { side: 'dli'; number: number; field: string };

export const selection = signal<Selection | undefined>();

/** Points at the first field of a message that is translated, so that a rule is seen before anybody has pointed. */
export function selectFirstMapped(message: MavlinkMessage | undefined): void {
  const fields = message && catalogue.value?.mavlink(message)?.fields;
  const first = fields?.find(({ name }) => catalogue.value!.targetsOf(message!.name, name).length > 0);
  selection.value = first && { side: 'mavlink', message: message!.name, field: first.name };
}

/** The MAVLink fields `NAME.field` and the DLI fields `number.key` that belong to the selection, itself included. */
export const marked = computed(() => {
  const mavlink = new Set<string>();
  const dli = new Set<string>();
  const chosen = selection.value;
  if (chosen?.side === 'mavlink') {
    mavlink.add(`${chosen.message}.${chosen.field}`);
    for (const { number, field } of catalogue.value?.targetsOf(chosen.message, chosen.field) ?? [])
      dli.add(`${number}.${field}`);
  } else if (chosen?.side === 'dli') {
    dli.add(`${chosen.number}.${chosen.field}`);
    for (const { fromMavlink } of catalogue.value?.chainsOf(chosen.number, chosen.field) ?? [])
      for (const { message, sources } of fromMavlink) for (const source of sources) mavlink.add(`${message}.${source}`);
  }
  return { mavlink, dli };
});

/** The flow (see `Crossings`) that the panes show; none: the first. */
export const chosenFlow = signal<string | undefined>();
