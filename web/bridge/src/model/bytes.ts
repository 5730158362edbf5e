/** Bytes from `start` up to, and without, `end`. */
export interface Range {
  start: number;
  end: number;
}

/** A named piece of a header: where it stands and its unsigned value. */
export interface HeaderField {
  name: string;
  range: Range;
  value: number;
}

/** The bytes that a text of hexadecimal digits stands for. */
export function bytesOf(hex: string): Uint8Array {
  const bytes = new Uint8Array(hex.length / 2);
  for (let index = 0; index < bytes.length; ++index) bytes[index] = parseInt(hex.slice(2 * index, 2 * index + 2), 16);
  return bytes;
}

/** Two hexadecimal digits. */
export function hexByte(byte: number): string {
  return byte.toString(16).padStart(2, '0');
}

/** The bytes of a range in hexadecimal, with spaces between them. */
export function hexOf(bytes: Uint8Array, range: Range): string {
  return Array.from(bytes.subarray(range.start, range.end), hexByte).join(' ');
}

/** The unsigned integer of at most 6 bytes in a range, most significant byte first. */
export function unsignedBigEndian(bytes: Uint8Array, range: Range): number {
  return bytes.subarray(range.start, range.end).reduce((value, byte) => value * 256 + byte, 0);
}

/** The same, least significant byte first. */
export function unsignedLittleEndian(bytes: Uint8Array, range: Range): number {
  return bytes.subarray(range.start, range.end).reduceRight((value, byte) => value * 256 + byte, 0);
}

/** Names header fields that follow one another: `[name, bytes]` each. */
export function headerFields(
  bytes: Uint8Array,
  start: number,
  pieces: readonly (readonly [string, number])[],
  read: (bytes: Uint8Array, range: Range) => number,
): HeaderField[] {
  let at = start;
  return pieces.map(([name, size]) => {
    const range = { start: at, end: at + size };
    at += size;
    return { name, range, value: read(bytes, range) };
  });
}
