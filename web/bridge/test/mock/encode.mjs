// Writes the bytes of both protocols from the catalogue: for tests only, and no part of the product.
import { catalogue, crcExtra } from './catalogue.mjs';

const setters = {
  char: ['setUint8', 1],
  uint8: ['setUint8', 1],
  int8: ['setInt8', 1],
  uint16: ['setUint16', 2],
  int16: ['setInt16', 2],
  uint32: ['setUint32', 4],
  int32: ['setInt32', 4],
  float: ['setFloat32', 4],
};

const hexOf = (bytes) => Buffer.from(bytes).toString('hex');

function checksum(bytes, extra) {
  let crc = 0xffff;
  for (const byte of [...bytes, extra]) {
    let mixed = (byte ^ crc) & 0xff;
    mixed = (mixed ^ (mixed << 4)) & 0xff;
    crc = ((crc >> 8) ^ (mixed << 8) ^ (mixed << 3) ^ (mixed >> 4)) & 0xffff;
  }
  return crc;
}

/** A MAVLink 2 frame in hexadecimal. */
export function mavlinkHex({ id, system, component, sequence, fields }) {
  const info = catalogue.mavlink.messages.find((message) => message.id === id);
  const size = Math.max(
    ...info.fields.map(({ type, array_length = 1, offset }) => offset + setters[type][1] * array_length),
  );
  const payload = new DataView(new ArrayBuffer(size));
  for (const { name, type, array_length, offset } of info.fields) {
    const [set, width] = setters[type];
    const elements =
      type === 'char' ? [...Buffer.from(fields[name])] : array_length === undefined ? [fields[name]] : fields[name];
    elements.forEach((element, index) => payload[set](offset + width * index, element, true));
  }
  let length = size;
  while (length > 1 && payload.getUint8(length - 1) === 0) --length;
  const head = [length, 0, 0, sequence, system, component, id & 0xff, (id >> 8) & 0xff, id >> 16];
  const body = [...head, ...new Uint8Array(payload.buffer, 0, length)];
  const crc = checksum(body, crcExtra[id]);
  return hexOf([0xfd, ...body, crc & 0xff, crc >> 8]);
}

function bigEndian(value, width) {
  const unsigned = BigInt.asUintN(8 * width, BigInt(value));
  return Array.from({ length: width }, (_, index) => Number((unsigned >> BigInt(8 * (width - 1 - index))) & 0xffn));
}

/** The JSON of a DLI message whose fields have these raw values, and its bytes in hexadecimal. */
export function dliMessage({ number, time_ms, source, raws, held = {}, labels = {} }) {
  const info = catalogue.dli.messages.find((message) => message.number === number);
  let vector = 0n;
  const data = [];
  for (const { key, number: bit, type, width } of info.fields) {
    if (raws[key] === undefined) continue;
    vector |= 1n << BigInt(bit - 1);
    data.push(
      ...(type === 'text'
        ? Buffer.alloc(width, raws[key], 'ascii').fill(0, raws[key].length)
        : bigEndian(raws[key], width)),
    );
  }
  const body = [...bigEndian(vector, info.presence_bytes), ...data];
  const destination = 'FF:FF:FF:FF';
  const id = (text) => text.split(':').map((part) => parseInt(part, 16));
  const bytes = [
    0xff,
    0xff,
    ...bigEndian(body.length, 2),
    ...id(source),
    ...id(destination),
    ...bigEndian(number, 2),
    0x1e,
    0x80,
    ...body,
  ];
  const sum = bytes.reduce((total, byte) => total + byte, 0);
  const fieldsOf = (values) =>
    Object.fromEntries(
      info.fields
        .filter(({ key }) => values[key] !== undefined)
        .map(({ key, scale, unit }) => {
          const raw = values[key];
          return [key, { raw, ...(scale && { value: raw * scale, unit }), ...(labels[key] && { label: labels[key] }) }];
        }),
    );
  return {
    time_ms,
    number,
    name: info.name,
    edition: '3',
    source,
    destination,
    fields: fieldsOf(raws),
    held: fieldsOf(held),
    hex: hexOf([...bytes, ...bigEndian(sum, 4)]),
  };
}

/** The raw value of a physical value in a field's scale. */
export function rawOf(number, key, value) {
  const { scale } = catalogue.dli.messages
    .find((message) => message.number === number)
    .fields.find((field) => field.key === key);
  return Math.round(value / scale);
}
