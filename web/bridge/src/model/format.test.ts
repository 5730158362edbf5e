import { expect, it } from 'vitest';
import { durationText, fixed, meaningText, plain, sizeText, valueText } from './format';

it.each([
  [0, '0\u00a0ns'],
  [999, '999\u00a0ns'],
  [1000, '1.00\u00a0µs'],
  [25_340, '25.3\u00a0µs'],
  [999_600, '1.00\u00a0ms'],
  [500e6, '500\u00a0ms'],
  [61e9, '61.0\u00a0s'],
])('%d ns is %s', (nanoseconds, text) => {
  expect(durationText(nanoseconds)).toBe(text);
});

it('never shows a negative zero', () => {
  expect(fixed(-0.001, 2)).toBe('0.00');
  expect(fixed(-0.01, 2)).toBe('-0.01');
});

it('drops what binary fractions add and keeps every digit of a time', () => {
  expect(plain(90.10000000000001)).toBe('90.1');
  expect(plain(848631462.391)).toBe('848631462.391');
});

it('shows arrays, texts and what JSON numbers cannot hold', () => {
  expect(valueText([3900, 'NaN'])).toBe('[3900, NaN]');
  expect(valueText('18446744073709551615')).toBe('18446744073709551615');
  expect(valueText(1795348847933355)).toBe('1795348847933355');
});

it('shows sizes', () => {
  expect([sizeText(999), sizeText(18_500), sizeText(2_500_000)]).toEqual(['999\u00a0B', '18.5\u00a0kB', '2.5\u00a0MB']);
});

it('shows what a DLI field means', () => {
  expect(meaningText({ raw: 3, label: 'WGS-84' }, 'si')).toBe('WGS-84');
  expect(meaningText({ raw: 5, label: ['Station 1', 'Station 3'] }, 'si')).toBe('Station 1 | Station 3');
  expect(meaningText({ raw: 1820, value: 0.17449, unit: 'rad' }, 'aviation')).toBe('10.00°');
  expect(meaningText({ raw: 10, value: 10, unit: 's' }, 'si')).toBe('10 s');
  expect(meaningText({ raw: -1 }, 'si')).toBe('');
});
