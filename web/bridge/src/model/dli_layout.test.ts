import { expect, it } from 'vitest';
import type { DliMessageInfo } from '../contract';
import { bytesOf, hexOf } from './bytes';
import { dliLayout } from './dli_layout';

const field = (number: number, key: string, width: number) => ({ number, key, name: key, type: 'bam' as const, width });
const inertialStates: DliMessageInfo = {
  number: 4000,
  name: 'Inertial States',
  presence_bytes: 3,
  confidence: 'standard',
  fields: [field(1, 'time_stamp', 5), field(12, 'roll', 2), field(13, 'pitch', 2), field(14, 'heading', 2)],
};

// Wrapper of 16 bytes, presence vector of fields 1, 12 and 14, the three fields, a checksum of four bytes.
const wrapper = 'ffff000c1440000114200002' + '0fa01e80';
const message = bytesOf(`${wrapper}002801c5aa000001071cfc72000005d0`);

it('names the pieces of the wrapper', () => {
  const { wrapper: pieces } = dliLayout(message, inertialStates, {});
  expect(pieces.map(({ name, value }) => [name, value])).toEqual([
    ['Sequence #', 0xffff],
    ['Message Length', 12],
    ['Source ID', 0x14400001],
    ['Destination ID', 0x14200002],
    ['Message Type', 4000],
    ['Message Properties', 0x1e80],
    ['checksum', 0x05d0],
  ]);
});

it('finds the present fields behind the vector, in the order of their bits', () => {
  const { fields, presence } = dliLayout(message, inertialStates, {});
  expect(hexOf(message, presence)).toBe('00 28 01');
  expect([...fields].map(([key, range]) => [key, hexOf(message, range)])).toEqual([
    ['time_stamp', 'c5 aa 00 00 01'],
    ['roll', '07 1c'],
    ['heading', 'fc 72'],
  ]);
});

it('tells every bit as it was sent, with the field it stands for', () => {
  const { bits } = dliLayout(message, inertialStates, {});
  expect(bits).toHaveLength(24);
  expect(bits[0]).toMatchObject({ bit: 23, present: false, field: undefined });
  expect(bits.filter(({ present }) => present).map(({ bit, field }) => [bit, field?.key])).toEqual([
    [13, 'heading'],
    [11, 'roll'],
    [0, 'time_stamp'],
  ]);
});

it('takes the length of a variable text from the field that tells it', () => {
  const info: DliMessageInfo = {
    ...inertialStates,
    presence_bytes: 1,
    fields: [
      { ...field(1, 'length', 1), type: 'unsigned' },
      { ...field(2, 'text', 0), type: 'variable_text', length_from: 1 },
      field(3, 'after', 2),
    ],
  };
  const bytes = bytesOf('ffff0007' + '00'.repeat(12) + '07' + '03' + '414243' + '1234');
  const { fields } = dliLayout(bytes, info, { length: { raw: 3 } });
  expect(hexOf(bytes, fields.get('text')!)).toBe('41 42 43');
  expect(hexOf(bytes, fields.get('after')!)).toBe('12 34');
});

it('shows the wrapper of a message that the catalogue does not know', () => {
  const { bits, fields } = dliLayout(message, undefined, {});
  expect(bits).toEqual([]);
  expect(fields.size).toBe(0);
});
