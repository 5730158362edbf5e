import { expect, it } from 'vitest';
import { bytesOf, hexOf } from './bytes';
import { mavlinkFieldRange, mavlinkLayout } from './mavlink_layout';

// HEARTBEAT of system 1, component 1, sequence 42, in MAVLink 2 and 1.
const heartbeat2 = 'fd0900002a01010000000400000002035104038fa1';
const heartbeat1 = 'fe092a01010004000000020351040339d5';

const values = (hex: string) =>
  Object.fromEntries(mavlinkLayout(bytesOf(hex)).header.map(({ name, value }) => [name, value]));

it('reads the header of MAVLink 2', () => {
  expect(values(heartbeat2)).toMatchObject({
    start: 0xfd,
    'payload length': 9,
    sequence: 42,
    'system id': 1,
    'message id': 0,
    checksum: 0xa18f,
  });
});

it('reads the header of MAVLink 1', () => {
  expect(values(heartbeat1)).toMatchObject({ start: 0xfe, sequence: 42, 'component id': 1, checksum: 0xd539 });
});

it('finds a field in the payload', () => {
  const bytes = bytesOf(heartbeat2);
  const { payload } = mavlinkLayout(bytes);
  expect(hexOf(bytes, mavlinkFieldRange({ name: 'custom_mode', type: 'uint32', offset: 0 }, payload))).toBe(
    '04 00 00 00',
  );
  expect(hexOf(bytes, mavlinkFieldRange({ name: 'base_mode', type: 'uint8', offset: 6 }, payload))).toBe('51');
});

it('cuts a field at the end of a payload whose trailing zeros were not sent', () => {
  const payload = { start: 10, end: 13 };
  expect(mavlinkFieldRange({ name: 'a', type: 'uint32', offset: 0 }, payload)).toEqual({ start: 10, end: 13 });
  expect(mavlinkFieldRange({ name: 'b', type: 'uint16', offset: 4, array_length: 3 }, payload)).toEqual({
    start: 13,
    end: 13,
  });
});

it('names the pieces of a signature', () => {
  const signed = `fd0101002a010100000004${'8fa1'}07${'010000000000'}${'aabbccddeeff'}`;
  expect(values(signed)).toMatchObject({ 'signature: link id': 7, 'signature: time stamp': 1 });
  expect(mavlinkLayout(bytesOf(signed)).header.at(-1)!.range.end).toBe(signed.length / 2);
});
