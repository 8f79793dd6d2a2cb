// Numbers from their packed form (packed_numbers.h): base64, gzip, low and high bytes apart, zigzag, differences.
// @ts-nocheck

/** Bytes of a base64 text. */
export function bytesOf(base64) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

export const inflated = base64 =>
    new Response(new Blob([bytesOf(base64)]).stream().pipeThrough(new DecompressionStream('gzip')));

/** Whole numbers of 16 bits; sums wrap as the differences did. */
export async function unpack(packed) {
  if (!packed?.count) return new Uint16Array(0);
  const {count, lag, order, data} = packed;
  const planes = new Uint8Array(await inflated(data).arrayBuffer());
  const values = new Uint16Array(count);
  for (let i = 0; i < count; ++i) {
    const zigzag = planes[i] | (planes[count + i] << 8);
    values[i] = (zigzag >>> 1) ^ -(zigzag & 1);
  }
  for (let k = order; k > 0; --k)
    for (let i = k * lag; i < count; ++i) values[i] += values[i - lag];
  return values;
}

/** The numbers of a file of runs (motions.h), and where in them those of each run begin; opened once. */
export function opened(set, wide) {
  return set.opened ??= (async () => {
           if (set.packed) set.runs ??= await inflated(set.packed).json();
           const [shapes, paths, values] = await Promise.all([set.shapes, set.paths, set.values].map(unpack));
           const numbers = {shapes: new Int16Array(shapes.buffer), paths: new Int16Array(paths.buffer), values},
                 begin = new Map();
           const at = {shapes: 0, paths: 0, values: 0};
           for (const run of [set.base, ...set.runs]) {
             if (!run) continue;
             begin.set(run, {...at});
             at.shapes += run.modes * wide, at.paths += run.modes * run.frames,
                 at.values += run === set.base ? 0 : 2 * run.frames;
           }
           return {numbers, begin};
         })();
}

/** Departures of a run from its base: frames x coordinates, m. */
export async function departuresOf(set, run, wide) {
  const {numbers: {shapes, paths}, begin} = await opened(set, wide), at = begin.get(run),
                                   {modes, frames, unit, path} = run;
  const out = new Float32Array(frames * wide);
  for (let k = 0; k < modes; ++k)
    for (let f = 0; f < frames; ++f) {
      const size = unit * path * paths[at.paths + k * frames + f], shape = at.shapes + k * wide;
      if (size !== 0)
        for (let i = 0; i < wide; ++i) out[f * wide + i] += size * shapes[shape + i];
    }
  return out;
}

/** Values of a run's frames, null where there is none: RMS distance from the truth (m), kinetic energy (J). */
export async function valuesOf(set, run, wide) {
  const {numbers: {values}, begin} = await opened(set, wide), {frames} = run;
  const from = begin.get(run).values;
  const list = kind => Array.from({length: frames}, (_, f) => values[from + kind * frames + f])
                           .map(
                               v =>
                                   (v > 1       ? 10 ** ((v - 40000) / 2000) :
                                        v === 1 ? 0 :
                                                  null));
  return {error: list(0), energy: list(1)};
}
