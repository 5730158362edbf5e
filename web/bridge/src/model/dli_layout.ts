import type { DliFieldInfo, DliFields, DliMessageInfo } from '../contract';
import { headerFields, unsignedBigEndian, type HeaderField, type Range } from './bytes';

const wrapper = [
  ['Sequence #', 2],
  ['Message Length', 2],
  ['Source ID', 4],
  ['Destination ID', 4],
  ['Message Type', 2],
  ['Message Properties', 2],
] as const;
const wrapperSize = 16;
const lengthIndex = 1;

/** One bit of the presence vector. */
export interface PresenceBit {
  bit: number; // 0 is the last bit of the last byte
  present: boolean;
  field: DliFieldInfo | undefined; // nothing: no field of this number is known
}

/** Where things stand in a DLI message. */
export interface DliLayout {
  wrapper: HeaderField[]; // checksum included
  presence: Range;
  bits: PresenceBit[]; // most significant first, as sent
  fields: Map<string, Range>; // by key, the present ones
}

/**
 * The layout of a whole message: wrapper, presence vector (one big-endian integer, whose bit n - 1 stands for field n),
 * the present fields without gaps, checksum. `values` are its fields: one may tell the length of a later one.
 */
export function dliLayout(bytes: Uint8Array, info: DliMessageInfo | undefined, values: DliFields): DliLayout {
  const header = headerFields(bytes, 0, wrapper, unsignedBigEndian);
  const dataEnd = Math.min(wrapperSize + header[lengthIndex]!.value, bytes.length);
  if (dataEnd < bytes.length)
    header.push(...headerFields(bytes, dataEnd, [['checksum', bytes.length - dataEnd]], unsignedBigEndian));

  const presence = { start: wrapperSize, end: Math.min(wrapperSize + (info?.presence_bytes ?? 0), dataEnd) };
  const bits = presenceBits(bytes, presence, info?.fields ?? []);
  const fields = new Map<string, Range>();
  let at = presence.end;
  for (const { present, field } of [...bits].reverse()) {
    if (!present || field === undefined) continue;
    const end = Math.min(at + widthOf(field, info!.fields, values), dataEnd);
    fields.set(field.key, { start: at, end });
    at = end;
  }
  return { wrapper: header, presence, bits, fields };
}

function presenceBits(bytes: Uint8Array, range: Range, fields: DliFieldInfo[]): PresenceBit[] {
  const byNumber = new Map(fields.map((field) => [field.number, field]));
  const count = 8 * (range.end - range.start);
  return Array.from({ length: count }, (_, index) => {
    const bit = count - 1 - index;
    const byte = bytes[range.start + (index >> 3)] ?? 0;
    return { bit, present: ((byte >> (bit & 7)) & 1) === 1, field: byNumber.get(bit + 1) };
  });
}

function widthOf(field: DliFieldInfo, fields: DliFieldInfo[], values: DliFields): number {
  if (field.length_from === undefined) return field.width;
  const key = fields.find((other) => other.number === field.length_from)?.key;
  return key === undefined ? 0 : Number(values[key]?.raw ?? 0);
}
