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

/** A place of a lattice from the number that wrapped at 2^16 (packed_numbers.h). */
const wrapped = number => ((number + 24576) & 0xffff) - 24576;

/** Numbers that were packed less those of another motion; it stays at its last frame. */
function over(other, numbers, perFrame) {
  const last = other.length - perFrame;
  return numbers.map((d, i) => d + other[Math.min(i - i % perFrame, last) + i % perFrame]);
}

/**
 * All packed arrays of a scene: what is drawn, and for each method its places, stretch and distances, unless these are
 * given.
 */
async function unpackScene(scene, given) {
  const none = new Uint16Array(0);
  const open = packed => (packed ? unpack(packed) : none);
  const [triangles, springs] = await Promise.all([open(scene.triangles), open(scene.springs.ends)]);
  if (given) return {triangles, springs, motions: given};
  const motions = await Promise.all(scene.methods.map(async method => {
    const [numbers, stretch, distance] =
        await Promise.all([open(method.places), open(method.stretch), open(method.distance)]);
    return {numbers, stretch, distance};
  }));
  motions.forEach((motion, m) => {
    const {over: other} = scene.methods[m];
    motion.places = other === undefined ? motion.numbers : over(motions[other].numbers, motion.numbers, 3 * scene.particles);
  });
  for (const motion of motions) motion.places = Int32Array.from(motion.places, wrapped);
  return {triangles, springs, motions};
}
