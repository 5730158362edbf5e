import type { DliValue, MavlinkValue } from '../contract';
import { shownFromWire, type Shown, type UnitSystem } from './units';

/** A number with fixed decimals, never "-0.0". */
export function fixed(value: number, decimals: number): string {
  if (!Number.isFinite(value)) return String(value);
  const text = value.toFixed(decimals);
  return /^-[0.]+$/.test(text) ? text.slice(1) : text;
}

/** A value and its unit. */
export function shownText({ value, unit, decimals }: Shown): string {
  const space = unit.startsWith('°') && unit !== '°C' ? '' : '\u00a0';
  return `${fixed(value, decimals)}${space}${unit}`;
}

/** Every digit that means something, without those that binary fractions add. */
export function plain(value: number): string {
  return String(Number(value.toPrecision(12)));
}

/** What a MAVLink field says, to the last digit. */
export function valueText(value: MavlinkValue): string {
  return Array.isArray(value) ? `[${value.map(valueText).join(', ')}]` : String(value);
}

/** What a DLI field means beyond its raw value: a label, or a value in the unit system; empty where there is nothing. */
export function meaningText({ value, unit, label }: DliValue, system: UnitSystem): string {
  if (label !== undefined) return typeof label === 'string' ? label : label.join(' | ');
  if (value === undefined) return '';
  const shown = shownFromWire(value, unit, system);
  return shown ? shownText(shown) : `${plain(value)} ${unit ?? ''}`;
}

/** A duration in the unit that suits it: ns, µs, ms or s, with three digits. */
export function durationText(nanoseconds: number): string {
  const units = ['ns', 'µs', 'ms', 's'];
  let value = nanoseconds;
  let unit = 0;
  while (value >= 999.5 && unit < units.length - 1) {
    value /= 1000;
    ++unit;
  }
  const decimals = unit === 0 || value >= 99.95 ? 0 : value >= 9.995 ? 1 : 2;
  return `${value.toFixed(decimals)}\u00a0${units[unit]!}`;
}

/** Bytes, kB or MB a second or in all. */
export function sizeText(bytes: number): string {
  if (bytes < 1000) return `${bytes}\u00a0B`;
  if (bytes < 1e6) return `${(bytes / 1e3).toFixed(1)}\u00a0kB`;
  return `${(bytes / 1e6).toFixed(1)}\u00a0MB`;
}

/** The time of day, UTC, to the millisecond. */
export function timeText(milliseconds: number): string {
  return new Date(milliseconds).toISOString().slice(11, 23);
}
