import { hexByte, type Range } from '../../model/bytes';

/** A part of the bytes that is drawn in a manner of its own. */
export interface Region {
  name: 'header' | 'presence' | 'payload';
  range: Range;
}

interface Run {
  text: string;
  region: Region['name'];
  isMarked: boolean;
}

/** Bytes in hexadecimal; those of the marked ranges stand out. */
export function HexBytes(props: { label: string; bytes: Uint8Array; regions: Region[]; marks: Range[] }) {
  return (
    <p class="hex-bytes" role="group" aria-label={props.label}>
      {runs(props.bytes, props.regions, props.marks).map(({ text, region, isMarked }, index) => (
        <>
          {index > 0 && ' '}
          {isMarked ? <mark class={region}>{text}</mark> : <span class={region}>{text}</span>}
        </>
      ))}
    </p>
  );
}

// Neighbours that look alike share an element.
function runs(bytes: Uint8Array, regions: Region[], marks: Range[]): Run[] {
  const holds = (at: number) => (range: Range) => range.start <= at && at < range.end;
  const result: Run[] = [];
  bytes.forEach((byte, at) => {
    const region = regions.find(({ range }) => holds(at)(range))?.name ?? 'header';
    const isMarked = marks.some(holds(at));
    const last = result.at(-1);
    if (last !== undefined && last.region === region && last.isMarked === isMarked) last.text += ` ${hexByte(byte)}`;
    else result.push({ text: hexByte(byte), region, isMarked });
  });
  return result;
}
