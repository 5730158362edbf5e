import { effect, signal, type Signal } from '@preact/signals';
import { unitSystems, type UnitSystem } from '../model/units';
import type { Language } from '../text';

export const themes = ['system', 'light', 'dark', 'contrast'] as const;
export type Theme = (typeof themes)[number];

/** A setting that the browser keeps for the next visit. A stored value that is none of `values` is ignored. */
function kept<T extends string>(name: string, values: readonly T[], initial: T): Signal<T> {
  const stored = read(name);
  const setting = signal(values.find((value) => value === stored) ?? initial);
  effect(() => write(name, setting.value));
  return setting;
}

// A browser may forbid storage; then settings last as long as the page.
function read(name: string): string | null {
  try {
    return localStorage.getItem(`ponte.${name}`);
  } catch {
    return null;
  }
}
function write(name: string, value: string): void {
  try {
    localStorage.setItem(`ponte.${name}`, value);
  } catch {
    return;
  }
}

export const settings = {
  language: kept<Language>('language', ['en', 'pt'], navigator.language.startsWith('pt') ? 'pt' : 'en'),
  units: kept<UnitSystem>('units', unitSystems, 'si'),
  theme: kept<Theme>('theme', themes, 'system'),
  keys: kept<'on' | 'off'>('keys', ['on', 'off'], 'on'),
};

effect(() => {
  document.documentElement.lang = settings.language.value === 'pt' ? 'pt-PT' : 'en';
  document.documentElement.dataset.theme = settings.theme.value;
});

/** The value after this one, around the list. */
export function next<T>(values: readonly T[], value: T): T {
  return values[(values.indexOf(value) + 1) % values.length]!;
}
