// Runs of the player whose motions the page does not hold: the engine computes them when they are first wanted, a slice
// at a time, so that the page answers meanwhile. And the doors from a run to the lab.
// @ts-nocheck

import {Motion, parts, runsOf} from '../player/motion';
import {departuresOf, unpack} from '../player/unpack';

import {LabError, labModule} from './engine';
import {sceneText} from './lab';
import {startOf} from './live_run';
import {numberAt, numbersOf, startSection, tomlNumber, withNumbers, withoutSection} from './scene_text';
import {say} from './words';

const computingSlice = 30;  // ms

const breath = () => new Promise(done => setTimeout(done));

/**
 * Places of a run at frames of the scene, one row each: coordinates, m. Throws LabError where it cannot be computed.
 */
async function computedPlaces(scene, method, {step, tolerance}, frames) {
  const lab = await labModule();
  if (!lab) throw new LabError('unsupported', say('noWasmForRun'));
  const sim = lab.open(sceneText(scene.scene));
  try {
    const {duration, samples, particles} = sim.scene, wide = 3 * particles;
    sim.start(startOf({method: method.replace(/^mysim\//, ''), step, tolerance}, duration, false));
    // the page's times are rounded: its frames are samples of the scene
    const last = scene.times.length - 1, stride = Math.round(scene.times[last] / duration * samples / last);
    const places = new Float64Array(frames.length * wide);
    let until = performance.now() + computingSlice;
    for (const [row, frame] of frames.entries()) {
      const time = frame * stride * duration / samples;
      while (!sim.ended && sim.t < time - 1e-9 * (step || 1)) {
        sim.advance(time, Math.max(1, until - performance.now()));
        if (performance.now() < until) continue;
        await breath();
        until = performance.now() + computingSlice;
      }
      places.set(sim.positions, row * wide);
    }
    return places;
  } finally {
    sim.close();
  }
}

/** The run of a scene that ties computed places to the base of all motions (computed_runs.h). */
function referenceOf(scene) {
  for (const file of ['engines', 'speed-accuracy'])
    for (const set of runsOf(`${scene.scene}-${file}`)?.sets.values() ?? [])
      for (const run of set.runs)
        if (run?.reference) return {set, run};
  return null;
}

/**
 * The base of a scene's motions, more exactly than the page holds it: the places of the reference, less its
 * departures.
 */
async function exactBase(scene) {
  const {set, run} = referenceOf(scene), wide = 3 * scene.particles;
  const [places, apart] =
      await Promise.all([computedPlaces(scene, set.name, run, [...scene.times.keys()]), departuresOf(set, run, wide)]);
  for (let frame = 0; frame < scene.times.length; ++frame) {
    const {first, next, part} = Motion.between(frame / run.every, run.frames);
    for (let i = 0; i < wide; ++i)
      places[frame * wide + i] -= apart[first * wide + i] + part * (apart[next * wide + i] - apart[first * wide + i]);
  }
  return places;
}

/** Departures of a run from its base, computed once: frames x coordinates, m. */
export function computedDepartures(scene, set, run, wide) {
  const compute = async () => {
    const last = scene.times.length - 1,
          frames = Array.from({length: run.frames}, (_, f) => Math.min(last, f * run.every));
    scene.exact ??= exactBase(scene);
    const [places, base] = await Promise.all([computedPlaces(scene, set.name, run, frames), scene.exact]);
    run.there = true;
    return Float32Array.from(places, (place, i) => place - base[frames[Math.floor(i / wide)] * wide + i % wide]);
  };
  return run.apart ??= compute().catch(problem => {
    run.apart = scene.exact = undefined;
    throw problem;
  });
}

// Cells of maps (computed_cells.h).

/** Whole numbers of so many words of 16 bits: the lowest words of all, then the next, the last with the sign. */
async function multiplesOf(packed, words) {
  const all = await unpack(packed), signed = new Int16Array(all.buffer), count = all.length / words, last = words - 1;
  return Float64Array.from({length: count}, (_, i) => {
    let number = signed[last * count + i];
    for (let word = last - 1; word >= 0; --word) number = 65536 * number + all[word * count + i];
    return number;
  });
}

/**
 * What the cells of a file start from: places of the rests, and of each row the text of its scene, with step and
 * duration still its own.
 */
async function startsOf(stage, set) {
  const {kind, rest, rows, ...packed} = set.starts, wide = 3 * stage.particles;
  const [places, moves] = await Promise.all([multiplesOf(packed.rests, 3), multiplesOf(packed.moves, 2)]);
  places.forEach((number, i) => (places[i] = number * rest));
  const each = moves.length / rows.length;
  return rows.map(({value, at, move, speed}, i) => {
    const base = places.subarray(at * wide, (at + 1) * wide), own = moves.subarray(i * each, (i + 1) * each);
    const x = base.map((place, c) => place + own[c] * move),
          v = Array.from(own.subarray(wide), number => number * speed);
    return {
      base,
      text: `${withoutSection(textOfRow(stage.toml, kind, value), 'camera').trimEnd()}\n\n${startSection(x, v)}`
    };
  });
}

/** The run of a map's cell, not begun yet, and the rest of its row. */
async function openCell(lab, stage, set, run) {
  const {text, base} = (await (set.rows ??= startsOf(stage, set)))[run.row], {steps, samples} = set.starts,
               duration = run.h * steps;
  const sim = lab.open(withNumbers(
      text, {'time.duration': duration, 'time.window': duration, 'time.samples': samples, 'time.step': run.h}));
  sim.start(startOf({method: set.name.replace(/^mysim\//, ''), step: run.h}, duration, false));
  return {sim, base};
}

/**
 * Departures of a map's cell from the rest of its row: pictures x coordinates, m. Throws LabError where it cannot be
 * computed.
 */
export async function cellDepartures(stage, set, run) {
  const lab = await labModule();
  if (!lab) throw new LabError('unsupported', say('noWasmForRun'));
  const {sim, base} = await openCell(lab, stage, set, run), wide = base.length,
              out = new Float32Array(run.frames * wide);
  try {
    for (let frame = 0; frame < run.frames; ++frame) {
      sim.advance(run.h * (run.first + frame * run.apart));
      sim.positions.forEach((place, i) => (out[frame * wide + i] = place - base[i]));
    }
  } finally {
    sim.close();
  }
  return out;
}

// Doors.

/** Whether the lab runs a method, options and all. */
const isOfLab = method =>
    Boolean(document.getElementById('lab-module')) && /^mysim\/[a-z0-9-]+(\+(events|sticky|linear))*$/.test(method);

/**
 * The small scene of a map with a row's stiffness (over its own) or drag rate. `taken`: what stands for a stiffness.
 */
function textOfRow(toml, kind, value, taken = stiffness => stiffness) {
  if (kind === 'drag')
    return `${withoutSection(toml, 'drag').trimEnd()}\n\n[drag]\ngamma = ${tomlNumber(value)}  # 1/s\n`;
  const lines = toml.split('\n');
  for (const {path, value: own, line, begin, end} of numbersOf(toml))
    if (/(^|\.)stiffness(\.|$)/.test(path))
      lines[line] = lines[line].slice(0, begin) + tomlNumber(taken(own * value)) + lines[line].slice(end);
  return lines.join('\n');
}

/** The scene of a map's cell for the lab: from the scene's own start, with numbers that are easily read. */
function textOfCell(toml, kind, value, step) {
  const text = textOfRow(toml, kind, value, stiffness => Number(stiffness.toPrecision(6)));
  // whole steps from one sample to the next, so that it is not shortened
  const samples = numberAt(text, 'time.samples'), interval = numberAt(text, 'time.duration') / samples;
  return withNumbers(
      text, {'time.duration': samples * Math.max(1, Math.ceil(interval / step)) * step, 'time.step': step});
}

/**
 * The state of the lab in which a mark of a figure opens: {scene, method, step or tolerance, toml}; null where the lab
 * has none.
 */
export function labStateOf(key, marker) {
  const file = runsOf(key), {method, place} = parts(marker.dataset.run);
  if (!isOfLab(method)) return null;
  if (file.stage) {
    const {step, value} = marker.dataset, {scene, toml} = file.stage;
    return toml && step ? {
      scene,
      method,
      step: Number(step),
      toml: textOfCell(toml, key.endsWith('-drag-map') ? 'drag' : 'stiffness', Number(value), Number(step))
    } :
                          null;
  }
  const run = file.sets.get(method)?.runs[place === 'own' ? 0 : Number(place)];
  return run && sceneText(file.scene) ? {scene: file.scene, method, step: run.step, tolerance: run.tolerance} : null;
}
