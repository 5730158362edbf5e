/** The degrees of a binary angle of `width` bytes: the full turn is 2^(8 width). */
export function degreesOfBinaryAngle(raw: number, width: number): number {
  return (raw * 360) / 2 ** (8 * width);
}

/** The two's complement of an integer of `width` bytes, in hexadecimal. */
export function twosComplementHex(raw: number, width: number): string {
  const range = 2 ** (8 * width);
  return (((raw % range) + range) % range).toString(16).padStart(2 * width, '0');
}
