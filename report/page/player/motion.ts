// A run's motion between its frames, and where its frames come from.
// @ts-nocheck

import {cellDepartures, computedDepartures} from '../lab/computed_runs';

import {departuresOf, valuesOf} from './unpack';

/** The frames of a base: frames x coordinates, m. */
async function baseOf(set, wide) {
  const places = await departuresOf(set, set.base, wide), {centre} = set.base;
  return places.map((d, i) => centre[i % 3] + d);
}

/** The runs of a file of the page (motions.h), by its key: "SCENE-engines", "SCENE-speed-accuracy", a map's. */
export const runsOf = (() => {
  const known = new Map();
  return key => {
    if (!known.has(key)) {
      const script = [...document.querySelectorAll('script.runs')].find(s => s.dataset.runs === key);
      const file = script ? JSON.parse(script.textContent) : null;
      if (file) file.sets = new Map(file.methods.map(set => [set.name, set]));
      known.set(key, file);
    }
    return known.get(key);
  };
})();

/**
 * A key as method and place: "mysim/leapfrog 5" is the method's sixth run of the chart, "own" the one at the scene's
 * own step.
 */
export const parts = key => {
  const at = key.lastIndexOf(' ');
  return {method: key.slice(0, at < 0 ? undefined : at), place: at < 0 ? '' : key.slice(at + 1)};
};

/** The file and the entry of a run; null where the page does not hold it. */
export function runOf(scene, key) {
  if (key === 'truth') return scene.known?.runs[0] ? {set: scene.known, run: scene.known.runs[0]} : null;
  const {method, place} = parts(key), own = place === 'own';
  const set = runsOf(`${scene.scene}-${own ? 'engines' : 'speed-accuracy'}`)?.sets.get(method);
  const run = set?.runs[own ? 0 : Number(place)];
  return run ? {set, run} : null;
}

/** All runs of a scene that the page holds: their keys by method, in the order of the steps. */
export function keysOf(scene) {
  const all = new Map();
  for (const [file, own] of [['engines', true], ['speed-accuracy', false]])
    for (const [name, set] of runsOf(`${scene.scene}-${file}`)?.sets ?? [])
      set.runs.forEach(
          (run, i) => run && all.set(name, [...(all.get(name) ?? []), own ? `${name} own` : `${name} ${i}`]));
  if (scene.known?.runs[0]) all.set('truth', ['truth']);
  return all;
}

/**
 * Where the frames of a run come from: the page's files, or the engine (computed_runs.js). Throws LabError where it
 * cannot compute them.
 */
export async function motionOf(scene, key) {
  const found = runOf(scene, key);
  if (!found) return null;
  const wide = 3 * scene.particles, {set, run} = found;
  scene.base ??= baseOf(scene.known, wide);
  const departures = run.computed ? computedDepartures(scene, set, run, wide) : departuresOf(set, run, wide);
  const [base, apart, values] = await Promise.all([scene.base, departures, valuesOf(set, run, wide)]);
  return new Motion(scene, {key, method: set.name, note: set.note, ...run}, {base, apart, ...values});
}

/** The same of a map's cell, on the map's own stage. Throws LabError where it cannot be computed. */
export async function cellOf(stage, set, run) {
  const wide = 3 * stage.particles,
        [base, apart] = await Promise.all(
            [baseOf(set, wide), run.computed ? cellDepartures(stage, set, run) : departuresOf(set, run, wide)]);
  return new Motion(stage, {key: '', method: set.name, ...run}, {base, apart, error: [], energy: []});
}

export class Motion {
  /** `base` and `apart`: frames x coordinates, m. */
  constructor(scene, run, {base, apart, error, energy}) {
    const {frames, times} = run, end = scene.times[scene.times.length - 1], last = scene.times.length - 1;
    Object.assign(this, {run, base, apart, error, energy, wide: 3 * scene.particles});
    // frames of the scene in a second; frames of the run at their times
    this.rate = last > 0 ? last / end : 0;
    const even = times && times.length < frames;
    this.times = Array.from(
        {length: frames},
        (_, f) =>
            (!times   ? f * run.every / (this.rate || 1) :
                 even ? times[0] + f * (times[1] - times[0]) / (frames - 1) :
                        times[f]));
    this.begin = times ? this.times[0] : 0;
    this.end = this.times[frames - 1];
  }

  get well() { return !this.run.failure; }

  /** Two rows of `count` and the part of the way between them. */
  static between(frame, count) {
    const at = Math.max(0, Math.min(count - 1, frame)), first = Math.floor(at);
    return {first, next: Math.min(count - 1, first + 1), part: at - first};
  }

  /** Row of the base, with fraction, at a time; a run that ended earlier stays at its end. */
  baseRow(time) { return this.run.at ?? this.rate * Math.min(time, this.end); }
  row(time) {
    const {times} = this, t = Math.max(times[0], Math.min(this.end, time));
    const next = Math.max(1, times.findIndex(other => other >= t - 1e-12));
    return times.length < 2 ? 0 : next - 1 + (t - times[next - 1]) / (times[next] - times[next - 1]);
  }

  /** A row of numbers with fraction, each added to what is there `size` times. */
  add(rows, row, size, into) {
    const {wide} = this, {first, next, part} = Motion.between(row, rows.length / wide);
    for (let i = 0, a = first * wide, b = next * wide; i < wide; ++i, ++a, ++b)
      into[i] +=
          size * Math.fround(rows[a] + part * (rows[b] - rows[a]));  // rounded, so that the same less the same is 0
  }

  /** Places at a time, or what they are apart from those of another motion: coordinates, m. */
  placesAt(time, into = new Float32Array(this.wide)) {
    into.fill(0);
    this.add(this.base, this.baseRow(time), 1, into);
    this.add(this.apart, this.row(time), this.run.larger ?? 1, into);
    return into;
  }
  apartAt(time, other, into = new Float32Array(this.wide)) {
    if (this.base === other.base && this.baseRow(time) === other.baseRow(time)) {
      // the base falls out: what is left may be far smaller than its numbers can tell
      into.fill(0);
      this.add(this.apart, this.row(time), 1, into);
      other.add(other.apart, other.row(time), -1, into);
      return into;
    }
    const theirs = other.placesAt(time);
    this.placesAt(time, into);
    for (let i = 0; i < this.wide; ++i) into[i] -= theirs[i];
    return into;
  }

  /** A value of the list of its frames at a time: between two that are there. */
  valueAt(list, time) {
    const {first, next, part} = Motion.between(this.row(time), this.times.length), a = list[first], b = list[next];
    return time > this.end + 1e-9 || a === null || a === undefined ? null : b === null ? a : a + part * (b - a);
  }
}

/** Distances of particles from departures, m. */
export const distances = apart => {
  const out = new Float32Array(apart.length / 3);
  for (let i = 0; i < out.length; ++i) out[i] = Math.hypot(apart[3 * i], apart[3 * i + 1], apart[3 * i + 2]);
  return out;
};
export const rms = values => Math.sqrt(values.reduce((sum, v) => sum + v * v, 0) / values.length);

/** Mean extension of the springs at each particle, %, without those that shear and bend. */
export function stretchOf(scene, {springs, rests}, places) {
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
