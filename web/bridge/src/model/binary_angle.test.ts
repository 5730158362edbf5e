import { expect, it } from 'vitest';
import { degreesOfBinaryAngle, twosComplementHex } from './binary_angle';

it.each([
  [1820, 2, 9.998, '071c'],
  [-910, 2, -4.999, 'fc72'],
  [-32768, 2, -180, '8000'],
  [2 ** 30, 4, 90, '40000000'],
])('%d in %d bytes is %d degrees', (raw, width, degrees, hex) => {
  expect(degreesOfBinaryAngle(raw, width)).toBeCloseTo(degrees, 3);
  expect(twosComplementHex(raw, width)).toBe(hex);
});
