// mysim in the page: the WebAssembly module, one instance of it for each scene and run (module.cpp is its other side).
// @ts-nocheck

import {inflated} from '../player/unpack';

import {withMethod, withStart} from './scene_text';

/** What the engine refused, in its own words. `kind`: "input", "unsupported", "solver", or "fault". */
export class LabError extends Error {
  constructor(kind, message) {
    super(message);
    this.kind = kind;
  }
}

/** The module of the page, compiled at the first call; null where there is none, or where the browser runs none. */
export const labModule = (() => {
  let compiled;
  const compile = async () => {
    const packed = document.getElementById('lab-module');
    if (!packed || !('WebAssembly' in window) || !('DecompressionStream' in window)) return null;
    try {
      return new Lab(await WebAssembly.compile(await inflated(JSON.parse(packed.textContent)).arrayBuffer()));
    } catch {
      return null;  // no SIMD, or WebAssembly is switched off
    }
  };
  return () => (compiled ??= compile());
})();

/** An instance of the module: its calls, its memory, and its texts. */
class Instance {
  constructor(module) {
    // the runtime's files: nothing is ever read or written, and nothing needs the rest
    const none = () => 0, files = new Proxy({}, {get: () => none});
    const page = {
      fail: (kind, message) => {
        throw new LabError(this.text(kind), this.text(message));
      },
      matches: (expression, text) => Number(new RegExp(this.text(expression)).test(this.text(text)))
    };
    this.calls = new WebAssembly.Instance(module, {page, wasi_snapshot_preview1: files}).exports;
    this.calls._initialize();
  }

  /** The text that ends with a zero byte at a place of the memory. */
  text(at) {
    const bytes = new Uint8Array(this.calls.memory.buffer, at);
    return new TextDecoder().decode(bytes.subarray(0, bytes.indexOf(0)));
  }

  /** Hands a text in, for the next call. */
  give(text) {
    const bytes = new TextEncoder().encode(text),
          at = this.calls.text_buffer(bytes.length);  // which may grow the memory
    new Uint8Array(this.calls.memory.buffer, at, bytes.length).set(bytes);
  }

  // Places are asked for before the memory is: a call may grow it, and its old buffer is then empty.
  doubles(at, count) { return new Float64Array(this.calls.memory.buffer, at, count); }
  integers(at, count) { return new Int32Array(this.calls.memory.buffer, at, count); }
}

class Lab {
  constructor(module) {
    this.module = module;
    const instance = new Instance(module);
    this.steppers = JSON.parse(instance.text(instance.calls.steppers()));
  }

  /** The scene of a TOML text, ready to be run. Throws LabError where it is not read. */
  open(toml) { return new Simulation(this, toml); }
}

const growthBudget = 50;  // ms

/** Arrows with the longest of them 1; null where there is none. */
function longestOne(arrows) {
  let most = 0;
  for (let i = 0; i < arrows.length; i += 3) most = Math.max(most, Math.hypot(arrows[i], arrows[i + 1], arrows[i + 2]));
  return most > 0 && Number.isFinite(most) ? Float64Array.from(arrows, part => part / most) : null;
}

/** A scene and one run of it. After an error that is not the scene's or a setting's the simulation is broken. */
class Simulation {
  constructor(lab, toml) {
    Object.assign(this, {lab, toml, broken: false, byHand: false, failure: null});
    this.instance = new Instance(lab.module);
    this.instance.give(toml);
    this.call('open');
    this.readScene();
  }

  /** Calls the engine. What it throws has ended the instance. */
  call(name, ...values) {
    if (this.broken) throw new LabError('fault', 'the run has ended');
    try {
      return this.instance.calls[name](...values);
    } catch (problem) {
      this.broken = true;
      if (problem instanceof LabError) throw problem;
      throw new LabError(
          'fault', problem instanceof RangeError ? 'not enough memory' : String(problem.message ?? problem));
    }
  }

  readScene() {
    const {instance} = this, scene = JSON.parse(instance.text(this.call('scene')));
    const {particles, springCount, constraintCount, triangleCount, pinCount} = scene;
    const integers = (name, count) => instance.integers(this.call(name), count).slice();
    const doubles = (name, count) => instance.doubles(this.call(name), count).slice();
    this.scene = {
      ...scene,
      pins: integers('pins', pinCount),
      springs: integers('spring_ends', 2 * springCount),
      constraints: integers('constraint_ends', 2 * constraintCount),
      constraintLengths: doubles('constraint_lengths', constraintCount),
      families: Uint8Array.from(integers('spring_families', springCount)),
      rests: doubles('spring_rests', springCount),
      triangles: integers('triangles', 3 * triangleCount),
      mass: doubles('masses', particles)
    };
    this.limits = new Map();
    const call = name => this.call(name);
    let omega = null;
    Object.defineProperty(
        this.scene, 'omega', {get: () => (omega ??= call('omega'))});  // found when it is asked for first
  }

  /**
   * The predicted critical step of a stepper, s: 0 where no step is stable, Infinity where all are, null where it
   * cannot be told.
   */
  limit(rule) {
    const name = rule.split('+')[0], row = this.lab.steppers.findIndex(stepper => stepper.name === name);
    if (row < 0) return null;
    if (!this.limits.has(row)) this.limits.set(row, this.call('critical_step', row));
    const limit = this.limits.get(row);
    return Number.isNaN(limit) ? null : limit;
  }

  /**
   * Begins a run at the scene's start. Without `observe` what is lost and what work is done is not added up, which
   * large scenes are faster without. Throws LabError where the rule does not take the scene.
   */
  start({
    stepper,
    options = '',
    step = this.scene.step,
    tolerance = 1e-6,
    duration = this.scene.duration,
    observe = true
  }) {
    this.run = {rule: stepper + options, step, tolerance, duration};
    this.failure = this.grown = null;
    this.instance.give(this.run.rule);
    this.call('start', step, tolerance, duration, Number(observe));
    this.going = true;
    this.remember();
  }

  /** Steps until the time t (s), or so many ms of computing have passed. True while the run goes on. */
  advance(t, budget = Infinity) {
    const until = performance.now() + budget;
    let most = 1;  // steps between two looks at the clock
    try {
      while (this.going && this.t < t - 1e-9 * this.run.step) {
        const begin = performance.now();
        this.going = Boolean(this.call('advance', t, most));
        const now = performance.now();
        if (now >= until) break;
        most = Math.max(1, Math.min(4096, Math.floor(most * Math.min(4, 2 / Math.max(0.1, now - begin)))));
      }
    } catch (problem) {
      if (problem.kind !== 'solver') throw problem;
      this.failure = {verdict: 'solver', reason: problem.message, t: this.t, h: this.h, steps: this.steps};
      this.going = false;
    }
    this.outcome = null;
    if (this.going) this.remember();
    return this.going;
  }

  /** Keeps the state, for when the next is not finite. */
  remember() {
    this.outcome = null;
    this.last = {positions: this.positions.slice(), velocities: this.velocities.slice(), t: this.t};
  }

  /** What the run has come to. */
  get result() { return (this.outcome ??= JSON.parse(this.instance.text(this.call('outcome')))); }
  get t() { return this.broken ? this.last.t : this.call('time'); }
  get h() { return this.failure?.h ?? this.result.step; }
  get steps() { return this.failure?.steps ?? this.result.steps; }
  get ended() { return !this.going; }
  get verdict() { return this.failure?.verdict ?? this.result.verdict; }
  get reason() { return this.failure?.reason ?? this.result.reason; }

  get positions() {
    return this.broken ? this.last.positions : this.instance.doubles(this.call('positions'), 3 * this.scene.particles);
  }
  get velocities() {
    if (this.scene.firstOrder) return new Float64Array(0);
    return this.broken ? this.last.velocities :
                         this.instance.doubles(this.call('velocities'), 3 * this.scene.particles);
  }

  /** Centres of the spheres at a time, m. */
  centres(t) {
    return this.broken ? new Float64Array(3 * this.scene.spheres.length) :
                         this.instance.doubles(this.call('centres', t), 3 * this.scene.spheres.length).slice();
  }

  /** Energies now, losses and work since the start, J; null in first-order scenes. */
  get energy() {
    const at = this.broken ? 0 : this.call('energies');
    if (!at) return null;
    const [kinetic, elastic, gravitational, drag, dashpots, contact, wind, pins, balance] =
        this.instance.doubles(at, 9);
    return {
      kinetic,
      elastic,
      gravitational,
      total: kinetic + elastic + gravitational,
      drag,
      dashpots,
      contact,
      wind,
      pins,
      balance
    };
  }

  /**
   * The mode that grows in a run that failed, its longest arrow 1. A run that failed late is not run once more, as no
   * frame may take that long: its last velocities that are finite stand for the mode.
   */
  get growth() {
    if (this.going || this.verdict === 'ok' || this.scene.firstOrder) return null;
    this.grown ??= this.growingMode(growthBudget).mode ??
        longestOne(this.velocities.every(Number.isFinite) ? this.velocities : this.last.velocities);
    return this.grown;
  }

  /**
   * What grows in a run like this one: how velocities change in a step while none moves a particle by more than a tenth
   * of the shortest spring, and the places then. Later the growth is no longer linear, and the mode is lost in others.
   * No mode where that takes more than so many ms.
   */
  growingMode(budget = Infinity) {
    const until = performance.now() + budget;
    const {rule, step, tolerance, duration} = this.run, [stepper, ...options] = rule.split('+');
    const twin = this.lab.open(this.sceneText()),
          small = 0.1 * this.scene.rests.reduce((a, b) => Math.min(a, b), Infinity);
    let mode = null, before = null, places = null;
    twin.start({stepper, options: options.map(word => `+${word}`).join(''), step, tolerance, duration, observe: false});
    for (let going = true, count = 0; going && count < 20000; ++count) {
      going = twin.advance(twin.t + 0.5 * step);
      const now = twin.velocities.slice(), change = before?.map((v, i) => now[i] - v);
      if (change && !change.every(v => Math.abs(v) * step < small)) break;
      if (performance.now() > until) {
        mode = null;
        break;
      }
      mode = change, before = now, places = twin.positions.slice();
    }
    twin.close();
    return {mode: mode && longestOne(mode), places};
  }

  /** 16 hexadecimal digits over the bits of positions and velocities. */
  fingerprint() { return this.instance.text(this.call('fingerprint')); }

  // By hand: the present state becomes the start of another scene, and the run goes on from there.

  hold(particle, [x, y, z]) { this.change('hold', particle, x, y, z); }
  release() { this.change('release'); }
  pin(particle) { this.change('set_pinned', particle, 1); }
  unpin(particle) { this.change('set_pinned', particle, 0); }

  change(name, ...values) {
    this.call(name, ...values);
    this.byHand = true;
    this.going = true;
    this.failure = this.grown = null;
    this.limits.clear();
    this.remember();
    this.begun = {...this.last, centres: this.centres(0)};
    const {pinCount} = JSON.parse(this.instance.text(this.call('scene')));
    this.scene.pins = this.instance.integers(this.call('pins'), pinCount).slice();
  }

  /**
   * The scene as it is now, with this run's method and step as its own; what was changed by hand stands in [start]. A
   * run of it by the command line gives the same bits.
   */
  sceneText() {
    const {rule, step, tolerance} = this.run;
    const own = withMethod(
        this.toml,
        this.lab.steppers.find(s => s.name === rule.split('+')[0]).adaptive ? {method: rule, tolerance} :
                                                                              {method: rule, step});
    return this.byHand ? withStart(own, this) : own;
  }

  close() {
    this.broken = true;
    this.instance = null;
  }
}
