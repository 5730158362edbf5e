import type { MavlinkFieldInfo, MavlinkType } from '../contract';
import { headerFields, unsignedLittleEndian, type HeaderField, type Range } from './bytes';

/** Where things stand in a MAVLink frame. */
export interface MavlinkLayout {
  header: HeaderField[]; // checksum and signature included
  payload: Range;
}

const header1 = [
  ['start', 1],
  ['payload length', 1],
  ['sequence', 1],
  ['system id', 1],
  ['component id', 1],
  ['message id', 1],
] as const;
const header2 = [
  ['start', 1],
  ['payload length', 1],
  ['incompatibility flags', 1],
  ['compatibility flags', 1],
  ['sequence', 1],
  ['system id', 1],
  ['component id', 1],
  ['message id', 3],
] as const;
const signature = [
  ['signature: link id', 1],
  ['signature: time stamp', 6],
] as const;
const signatureHash = 6;
const startOfVersion2 = 0xfd;
const signedFlag = 0x01;

/** The layout of a whole frame of MAVLink 1 (or 0.9) or 2. */
export function mavlinkLayout(frame: Uint8Array): MavlinkLayout {
  const isVersion2 = frame[0] === startOfVersion2;
  const pieces = isVersion2 ? header2 : header1;
  const header = headerFields(frame, 0, pieces, unsignedLittleEndian);
  const payloadStart = header.at(-1)!.range.end;
  const payload = { start: payloadStart, end: payloadStart + (frame[1] ?? 0) };
  header.push(...headerFields(frame, payload.end, [['checksum', 2]], unsignedLittleEndian));
  if (isVersion2 && ((frame[2] ?? 0) & signedFlag) !== 0)
    header.push(
      ...headerFields(frame, payload.end + 2, [...signature, ['signature: hash', signatureHash]], unsignedLittleEndian),
    );
  return { header, payload };
}

const sizes: Record<MavlinkType, number> = {
  char: 1,
  uint8: 1,
  int8: 1,
  uint16: 2,
  int16: 2,
  uint32: 4,
  int32: 4,
  uint64: 8,
  int64: 8,
  float: 4,
  double: 8,
};

/**
 * Where a field stands in the frame. MAVLink 2 does not send the zero bytes at the end of a payload, so the range may be
 * shorter than the field, or empty.
 */
export function mavlinkFieldRange(field: MavlinkFieldInfo, payload: Range): Range {
  const start = Math.min(payload.start + field.offset, payload.end);
  const size = sizes[field.type] * (field.array_length ?? 1);
  return { start, end: Math.min(payload.start + field.offset + size, payload.end) };
}
