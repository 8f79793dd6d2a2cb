// Numbers from their packed form (packed_numbers.h): base64, gzip, low and high bytes apart, zigzag, differences.

/** Bytes of a base64 text. */
function bytesOf(base64) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

/** Whole numbers of 16 bits; sums wrap as the differences did. */
async function unpack({count, lag, order, data}) {
  const stream = new Blob([bytesOf(data)]).stream().pipeThrough(new DecompressionStream('gzip'));
  const planes = new Uint8Array(await new Response(stream).arrayBuffer());
  const values = new Uint16Array(count);
  for (let i = 0; i < count; ++i) {
    const zigzag = planes[i] | (planes[count + i] << 8);
    values[i] = (zigzag >>> 1) ^ -(zigzag & 1);
  }
  for (let k = order; k > 0; --k)
    for (let i = k * lag; i < count; ++i) values[i] += values[i - lag];
  return values;
}

/**
 * All packed arrays of a scene: what is drawn, and for each method its places, stretch and distances, unless these are
 * given.
 */
async function unpackScene(scene, given) {
  const none = new Uint16Array(0);
  const open = packed => (packed ? unpack(packed) : none);
  const [triangles, springs] = await Promise.all([open(scene.triangles), open(scene.springs.ends)]);
  const motions = given ?? await Promise.all(scene.methods.map(async method => {
    const [places, stretch, distance] =
        await Promise.all([open(method.places), open(method.stretch), open(method.distance)]);
    return {places, stretch, distance};
  }));
  return {triangles, springs, motions};
}
