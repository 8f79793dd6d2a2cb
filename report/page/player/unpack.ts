// Unpacks numbers (report/CONTRACT.md): gzip, separate low and high bytes, zigzag, differences of rows.

// missing from older compilers' types
declare const DecompressionStream: new (format: string) => ReadableWritablePair<Uint8Array, Uint8Array>;

/** Rows of integers; `data`: base64. */
export interface Packed {
  count: number;
  columns: number;
  data: string;
}

export function bytesOf(base64: string) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

const inflatedBytes = (bytes: Uint8Array) =>
    new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip')));
export const inflated = (base64: string) => inflatedBytes(bytesOf(base64));

/** Unpacks rows of 16-bit integers. Sums wrap, as the differences did. */
export async function unpackedBytes(bytes: Uint8Array, columns: number) {
  const planes = new Uint8Array(await inflatedBytes(bytes).arrayBuffer()), count = planes.length / 2;
  const values = new Uint16Array(count);
  for (let i = 0; i < count; ++i) {
    const zigzag = planes[i] | (planes[count + i] << 8);
    values[i] = ((zigzag >>> 1) ^ -(zigzag & 1)) + (i < columns ? 0 : values[i - columns]);
  }
  return values;
}

export const unpack = async (packed: Packed|null) =>
    packed?.count ? unpackedBytes(bytesOf(packed.data), packed.columns) : new Uint16Array(0);
