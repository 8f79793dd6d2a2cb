// Runs of the page (report/CONTRACT.md), and motion between their frames.

import {SharedGeometry, StageScene} from './stage';
import {bytesOf, Packed, unpackedBytes} from './unpack';
import {Places} from './vectors';

/** A run in the format of report.json. */
export interface Run {
  step?: number;
  tolerance?: number;
  verdict: string;
  failed?: number;  // s
  reason?: string;
  frames: number;
  times: (number|null)[];  // s, times of all frames, or only the first and the last
  last_pictures?: boolean;
  low: number[];  // m
  unit: number;   // m
  offset: number;
  bytes: number;
  error?: (number|null)[];   // m
  energy?: (number|null)[];  // J
}

/** Runs of a method; `data`: base64, decoded once. */
export interface RunFile {
  method: string;
  note?: string;
  runs: (Run|null)[];
  data: string;
  content?: Uint8Array;
}

/** A scene, or the small scene of a map (from stage.cpp). */
export interface SceneStage {
  scene: string;
  particles: number;
  times: number[];
  from: number[];
  floor: number|null;
  triangles: Packed|null;
  springs: {
    ends: Packed,
    rests: Packed,
    rest_unit: number,
    threads: number,
    families: {name: string, count: number}[],
  };
  pins: number[];
  spheres: {radius: number, centres: number[][]}[];
  at?: number;  // s, time of the poster
  truth?: {name: string, rule: boolean, bar: number, motion: number};
  toml?: string;
}

/** Data of a scene that are unpacked once. */
export interface Shared {
  triangles: Uint16Array;
  springs: Uint16Array;
  rests: Uint16Array;
}

interface RunSet {
  scene: string;
  stage: SceneStage|null;
  methods: Map<string, RunFile>;
}

/** Runs of "SCENE-engines", "SCENE-speed-accuracy", "SCENE-truth", or a map; null if there are none. */
export const runsOf = (() => {
  const known = new Map<string, RunSet|null>();
  return (key: string) => {
    if (!known.has(key)) {
      const scripts = [...document.querySelectorAll<HTMLElement>('script.runs')].filter(s => s.dataset.runs === key);
      const parts = scripts.map(script => JSON.parse(script.textContent!));
      const files: RunFile[] = parts.flatMap(part => part.methods);
      known.set(key, parts.length ? {...parts[0], methods: new Map(files.map(file => [file.method, file]))} : null);
    }
    return known.get(key)!;
  };
})();

/** Splits a key: "mysim/leapfrog 5" is the method's sixth run in the chart, "own" the run at the scene's own step. */
export const parts = (key: string) => {
  const at = key.lastIndexOf(' ');
  return {method: key.slice(0, at < 0 ? undefined : at), place: at < 0 ? '' : key.slice(at + 1)};
};

/** File and entry of a run; null if the page does not contain it. */
export function runOf(scene: {scene: string}, key: string) {
  const {method, place} = parts(key), chosen = key === 'truth' || place === 'own' ? 0 : Number(place);
  const set = key === 'truth' ? 'truth' : place === 'own' ? 'engines' : 'speed-accuracy';
  const file = runsOf(`${scene.scene}-${set}`)?.methods.get(method), run = file?.runs[chosen];
  return file && run ? {file, run} : null;
}

/** Keys of all runs of a scene, by method, in the order of steps. */
export function keysOf(scene: {scene: string}) {
  const all = new Map<string, string[]>();
  for (const [set, own] of [['engines', true], ['speed-accuracy', false]])
    for (const [method, file] of runsOf(`${scene.scene}-${set}`)?.methods ?? [])
      file.runs.forEach((run, i) => {
        if (run) all.set(method, [...(all.get(method) ?? []), own ? `${method} own` : `${method} ${i}`]);
      });
  if (runOf(scene, 'truth')) all.set('truth', ['truth']);
  return all;
}

/** "blew up at 0.31 s" */
export function failureOf({verdict, failed}: Run, short: (value: number) => string) {
  if (verdict === 'ok' || failed === undefined) return '';
  const words: Record<string, string> = {
    stretch: 'overstretched',
    solver: 'solver gave up',
    frozen: 'froze',
    timeout: 'out of time',
    crash: 'program failed'
  };
  return `${words[verdict] ?? 'blew up'} at ${short(failed)} s`;
}

const numbersOf = ({particles}: SceneStage, file: RunFile, {offset, bytes}: Run) =>
    unpackedBytes((file.content ??= bytesOf(file.data)).subarray(offset, offset + bytes), 3 * particles);

/** Motion of a run; null if the page does not contain it. */
export async function motionOf(scene: SceneStage, key: string) {
  const found = runOf(scene, key);
  if (!found) return null;
  const {file, run} = found;
  return new Motion(run, key, file.method, scene.particles, await numbersOf(scene, file, run));
}

/** The last picture of a map's cell, as one frame; null if there is none. */
export async function cellOf(stage: SceneStage, file: RunFile, place: number) {
  const [run] = file.runs, time = run?.times[place] ?? null, wide = 3 * stage.particles;
  if (!run || time === null) return null;
  const numbers = (await numbersOf(stage, file, run)).subarray(place * wide, (place + 1) * wide);
  return new Motion({...run, frames: 1, times: [time]}, '', file.method, stage.particles, numbers);
}

export class Motion {
  readonly times: number[];  // s, times of the frames
  readonly begin: number;
  readonly end: number;
  readonly error: (number|null)[];   // m, one per frame
  readonly energy: (number|null)[];  // J, one per frame

  /** `numbers`: frames x 3 x particles. */
  constructor(
      readonly run: Run, readonly key: string, readonly method: string, private readonly particles: number,
      private readonly numbers: Uint16Array) {
    const {frames, times} = run, [first, last] = times as number[];
    this.times = times.length === frames ?
        times as number[] :
        Array.from({length: frames}, (_, f) => first + f * (last - first) / (frames - 1));
    this.begin = this.times[0], this.end = this.times[frames - 1];
    this.error = run.error ?? [], this.energy = run.energy ?? [];
  }

  get well() { return this.run.verdict === 'ok' || this.run.verdict === undefined; }

  /** Largest error of a position, m: half a unit in each direction. */
  get bound() { return Math.sqrt(3) / 2 * this.run.unit; }

  /** Frame at a time, as a fraction. */
  private frameAt(time: number) {
    const {times} = this, t = Math.max(times[0], Math.min(this.end, time));
    const next = Math.max(1, times.findIndex(other => other >= t - 1e-12));
    return times.length < 2 ? 0 : next - 1 + (t - times[next - 1]) / (times[next] - times[next - 1]);
  }

  /** Positions at a time (m), linear between frames; after the end of the run, its last positions. */
  placesAt(time: number, into = new Float32Array(3 * this.particles)) {
    const {particles, numbers, run} = this, frame = this.frameAt(time), first = Math.floor(frame), part = frame - first;
    const a = 3 * particles * first, b = part > 0 ? a + 3 * particles : a;
    for (let axis = 0; axis < 3; ++axis)
      for (let i = 0, from = axis * particles; i < particles; ++i, ++from)
        into[3 * i + axis] =
            run.low[axis] + run.unit * (numbers[a + from] + part * (numbers[b + from] - numbers[a + from]));
    return into;
  }

  /**
   * Coordinate differences (m) between two motions, interpolated between the frames that both have. Differences of
   * interpolated positions would have errors larger than the difference between two accurate runs.
   */
  apartAt(time: number, other: Motion, into = new Float32Array(3 * this.particles)) {
    const {times} = this.times.length < other.times.length ? this : other;
    const next = times.findIndex(t => t >= time - 1e-12), last = times.length - 1;
    const [before, after] = next <= 0 ? [times[next < 0 ? last : 0], 0] : [times[next - 1], times[next]];
    const part = next <= 0 ? 0 : (time - before) / (after - before);
    into.fill(0);
    for (const [t, size] of [[before, 1 - part], [after, part]]) {
      if (size < 1e-9) continue;
      const mine = this.placesAt(t), theirs = other.placesAt(t);
      for (let i = 0; i < into.length; ++i) into[i] += size * (mine[i] - theirs[i]);
    }
    return into;
  }

  /** Interpolates a list with one value per frame. */
  valueAt(list: (number|null)[], time: number) {
    const frame = this.frameAt(time), first = Math.floor(frame), a = list[first] ?? null, b = list[first + 1] ?? null;
    return time > this.end + 1e-9 || a === null ? null : b === null ? a : a + (frame - first) * (b - a);
  }
}

/** Distances (m) from differences of coordinates. */
export const distances = (apart: Float32Array) => {
  const out = new Float32Array(apart.length / 3);
  for (let i = 0; i < out.length; ++i) out[i] = Math.hypot(apart[3 * i], apart[3 * i + 1], apart[3 * i + 2]);
  return out;
};
export const rms = (values: Float32Array) => Math.sqrt(values.reduce((sum, v) => sum + v * v, 0) / values.length);

/** Mean extension at each particle, %, of springs that are not shear or bend springs. */
export function stretchOf(scene: StageScene, {springs, rests}: SharedGeometry, places: Places) {
  const sum = new Float32Array(scene.particles), count = new Float32Array(scene.particles);
  let s = 0;
  for (const {name, count: many} of scene.springs.families)
    for (const until = s + many; s < until; ++s) {
      if (name === 'shear' || name === 'bend' || !rests[s]) continue;
      const a = 3 * springs[2 * s], b = 3 * springs[2 * s + 1], rest = scene.springs.rest_unit * rests[s];
      const long = Math.hypot(places[b] - places[a], places[b + 1] - places[a + 1], places[b + 2] - places[a + 2]);
      for (const end of [a / 3, b / 3]) sum[end] += Math.max(0, 100 * (long / rest - 1)), ++count[end];
    }
  return sum.map((v, i) => v / Math.max(1, count[i]));
}
