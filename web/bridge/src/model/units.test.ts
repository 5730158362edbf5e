import { expect, it } from 'vitest';
import { shownText } from './format';
import { shown, shownFromWire, unitSystems } from './units';

it.each([
  [-300671099, 'degE7', 'si', '-0.5248\u00a0rad'],
  [-300671099, 'degE7', 'aviation', '-30.07°'],
  [50090, 'mm', 'si', '50.09\u00a0m'],
  [50090, 'mm', 'aviation', '164\u00a0ft'],
  [50090, 'mm', 'nautical', '50.09\u00a0m'],
  [1028.89, 'cm/s', 'nautical', '20.0\u00a0kn'],
  [3150, 'cdegC', 'si', '304.65\u00a0K'],
  [3150, 'cdegC', 'aviation', '31.5\u00a0°C'],
  [1013.25, 'hPa', 'si', '101325\u00a0Pa'],
  [3900, 'mV', 'si', '3.900\u00a0V'],
  [1000, 'mG', 'si', '9.807\u00a0m/s²'],
] as const)('%d %s in %s is %s', (value, unit, system, text) => {
  expect(shownText(shownFromWire(value, unit, system)!)).toBe(text);
});

it('shows climbing in feet per minute only where aviators read it', () => {
  expect(unitSystems.map((system) => shownText(shown('vertical speed', 5.08, system)))).toEqual([
    '5.08\u00a0m/s',
    '1000\u00a0ft/min',
    '5.08\u00a0m/s',
  ]);
});

it('does not convert what it does not know', () => {
  expect(shownFromWire(5, 'hJ', 'si')).toBeUndefined();
  expect(shownFromWire(5, undefined, 'si')).toBeUndefined();
});
