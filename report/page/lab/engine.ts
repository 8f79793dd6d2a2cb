// mysim in the page: the WebAssembly module (module.cpp), with an instance for each scene and its run.

import {inflated} from '../player/unpack';
import {Vec3} from '../player/vectors';

import {Start, withMethod, withStart} from './scene_text';

type FaultKind = 'input'|'unsupported'|'solver'|'fault';

export class LabError extends Error {
  constructor(readonly kind: FaultKind, message: string) { super(message); }
}

export interface Stepper {
  name: string;
  evaluations: number;  // force evaluations per step
  firstOrder: boolean;
  adaptive: boolean;
  hard: boolean;
}

interface Outcome {
  verdict: string;
  reason: string;
  step: number;  // s
  steps: number;
}

interface SceneHead {
  duration: number;  // s
  samples: number;
  step: number;  // s
  method: string;
  particles: number;
  springCount: number;
  constraintCount: number;
  triangleCount: number;
  pinCount: number;
  firstOrder: boolean;
  spheres: {radius: number}[];
  planes: {point: Vec3, normal: Vec3}[];
  camera: {eye: Vec3, target: Vec3}|null;
}
export interface EngineScene extends SceneHead {
  pins: Int32Array;
  springs: Int32Array;  // indices of both ends of each spring
  constraints: Int32Array;
  constraintLengths: Float64Array;  // m
  families: Int32Array;
  rests: Float64Array;  // m
  triangles: Int32Array;
}

export const solidsOf = ({spheres, planes}: EngineScene) => spheres.length + planes.length;

/** Current energies; losses and work since the start, J. */
export interface Energies {
  kinetic: number;
  elastic: number;
  gravitational: number;
  total: number;
  balance: number;
}

export interface RunSettings {
  stepper: string;
  options?: string;  // "+sticky"
  step?: number;     // s
  tolerance?: number;
  duration?: number;  // s
  observe?: boolean;
}

type Call = (...values: number[]) => number;
type Calls = Record<string, Call>&{memory: WebAssembly.Memory, _initialize: () => void};

/** The module, compiled at the first call; null if the page has none, or the browser does not support it. */
export const labModule = (() => {
  let compiled: Promise<Lab|null>|undefined;
  const compile = async () => {
    const packed = document.getElementById('lab-module');
    if (!packed?.textContent || !('WebAssembly' in window) || !('DecompressionStream' in window)) return null;
    try {
      return new Lab(await WebAssembly.compile(await inflated(JSON.parse(packed.textContent)).arrayBuffer()));
    } catch {
      return null;  // the browser lacks SIMD, or WebAssembly is disabled
    }
  };
  return () => (compiled ??= compile());
})();

class Instance {
  readonly calls: Calls;

  constructor(module: WebAssembly.Module) {
    // dummies for the runtime's file functions: the module uses no files
    const none = () => 0, files = new Proxy({}, {get: () => none});
    const page = {
      fail: (kind: number, message: number) => {
        throw new LabError(this.text(kind) as FaultKind, this.text(message));
      },
      matches: (expression: number, text: number) => Number(new RegExp(this.text(expression)).test(this.text(text)))
    };
    const {exports} = new WebAssembly.Instance(module, {page, wasi_snapshot_preview1: files});
    this.calls = exports as unknown as Calls;
    this.calls._initialize();
  }

  text(at: number) {
    const bytes = new Uint8Array(this.calls.memory.buffer, at);
    return new TextDecoder().decode(bytes.subarray(0, bytes.indexOf(0)));
  }

  /** Writes a text for the next call. */
  give(text: string) {
    const bytes = new TextEncoder().encode(text), at = this.calls.text_buffer(bytes.length);  // may grow the memory
    new Uint8Array(this.calls.memory.buffer, at, bytes.length).set(bytes);
  }

  // pass `at` as an argument, so that it is computed before the buffer is read: the call that computes it may grow the
  // memory, which detaches the old buffer
  doubles(at: number, count: number) { return new Float64Array(this.calls.memory.buffer, at, count); }
  integers(at: number, count: number) { return new Int32Array(this.calls.memory.buffer, at, count); }
}

export class Lab {
  readonly steppers: Stepper[];

  constructor(readonly module: WebAssembly.Module) {
    const instance = new Instance(module);
    this.steppers = JSON.parse(instance.text(instance.calls.steppers()));
  }

  /** The stepper of a method, whose name may have options, as in "implicit-euler+linear". */
  stepperOf(method: string) {
    const [name] = method.split('+');
    return this.steppers.find(stepper => stepper.name === name);
  }

  /** Throws LabError if the text (TOML) is not a valid scene. */
  open(toml: string) { return new Simulation(this, toml); }
}

const growthBudget = 50;  // ms

/** Scales arrows so that the longest has length 1; null if all are zero. */
function longestOne(arrows: Float64Array) {
  let most = 0;
  for (let i = 0; i < arrows.length; i += 3) most = Math.max(most, Math.hypot(arrows[i], arrows[i + 1], arrows[i + 2]));
  return most > 0 && Number.isFinite(most) ? arrows.map(part => part / most) : null;
}

/** A scene and a run. An error that is due to neither the scene nor a setting ends the run. */
export class Simulation {
  readonly scene: EngineScene;
  byHand = false;
  begun: Start|null = null;  // parameters of the last start, reset by a change by hand
  private readonly instance: Instance;
  private broken = false;
  private failure: (Outcome&{t: number})|null = null;
  private outcome: Outcome|null = null;
  private grown: Float64Array|null = null;
  private going = true;
  private limits = new Map<number, number>();
  private fastest: number|null = null;
  private run!: {rule: string, step: number, tolerance: number, duration: number};
  private last!: {positions: Float64Array, velocities: Float64Array, t: number};

  constructor(readonly lab: Lab, readonly toml: string) {
    this.instance = new Instance(lab.module);
    this.instance.give(toml);
    this.call('open');
    const scene: SceneHead = JSON.parse(this.instance.text(this.call('scene')));
    const {springCount, constraintCount, triangleCount, pinCount} = scene;
    const integers = (name: string, count: number) => this.instance.integers(this.call(name), count).slice();
    const doubles = (name: string, count: number) => this.instance.doubles(this.call(name), count).slice();
    this.scene = {
      ...scene,
      pins: integers('pins', pinCount),
      springs: integers('spring_ends', 2 * springCount),
      constraints: integers('constraint_ends', 2 * constraintCount),
      constraintLengths: doubles('constraint_lengths', constraintCount),
      families: integers('spring_families', springCount),
      rests: doubles('spring_rests', springCount),
      triangles: integers('triangles', 3 * triangleCount)
    };
  }

  /** An exception ends the instance. */
  call(name: string, ...values: number[]): number {
    if (this.broken) throw new LabError('fault', 'the run has ended');
    try {
      return this.instance.calls[name](...values);
    } catch (problem) {
      this.broken = true;
      if (problem instanceof LabError) throw problem;
      throw new LabError('fault', problem instanceof RangeError ? 'not enough memory' : String(problem));
    }
  }

  /** Fastest vibration in the initial state, rad/s; 0 if nothing vibrates. */
  get omega() { return (this.fastest ??= this.call('omega')); }

  /** Predicted critical step, s: 0 if no step is stable, Infinity if all steps are, null if it is unknown. */
  limit(rule: string) {
    const row = this.lab.steppers.indexOf(this.lab.stepperOf(rule)!);
    if (row < 0) return null;
    const limit = this.limits.get(row) ?? this.call('critical_step', row);
    this.limits.set(row, limit);
    return Number.isNaN(limit) ? null : limit;
  }

  /** Without `observe`, does not accumulate losses and work. Throws LabError if the rule refuses the scene. */
  start(
      {stepper, options = '', step = this.scene.step, tolerance = 1e-6, duration = this.scene.duration, observe = true}:
          RunSettings) {
    this.run = {rule: stepper + options, step, tolerance, duration};
    this.failure = this.grown = null;
    this.instance.give(this.run.rule);
    this.call('start', step, tolerance, duration, Number(observe));
    this.going = true;
    this.remember();
  }

  /** Steps until t (s), but computes for at most `budget` ms. Returns true while the run goes on. */
  advance(t: number, budget = Infinity) {
    const until = performance.now() + budget;
    let most = 1;  // number of steps until the clock is read again
    try {
      while (this.going && this.t < t - 1e-9 * this.run.step) {
        const begin = performance.now();
        this.going = Boolean(this.call('advance', t, most));
        const now = performance.now();
        if (now >= until) break;
        most = Math.max(1, Math.min(4096, Math.floor(most * Math.min(4, 2 / Math.max(0.1, now - begin)))));
      }
    } catch (problem) {
      if (!(problem instanceof LabError) || problem.kind !== 'solver') throw problem;
      this.failure = {verdict: 'solver', reason: problem.message, t: this.t, step: this.h, steps: this.steps};
      this.going = false;
    }
    this.outcome = null;
    if (this.going) this.remember();
    return this.going;
  }

  /** Saves the state, in case the next state is not finite. */
  private remember() {
    this.outcome = null;
    this.last = {positions: this.positions.slice(), velocities: this.velocities.slice(), t: this.t};
  }

  private get result(): Outcome {
    return this.failure ?? (this.outcome ??= JSON.parse(this.instance.text(this.call('outcome'))) as Outcome);
  }
  get t() { return this.broken ? this.last.t : this.call('time'); }
  get h() { return this.result.step; }
  get steps() { return this.result.steps; }
  get ended() { return !this.going; }
  get verdict() { return this.result.verdict; }
  get reason() { return this.result.reason; }

  get positions() {
    return this.broken ? this.last.positions : this.instance.doubles(this.call('positions'), 3 * this.scene.particles);
  }
  get velocities() {
    if (this.scene.firstOrder) return new Float64Array(0);
    return this.broken ? this.last.velocities :
                         this.instance.doubles(this.call('velocities'), 3 * this.scene.particles);
  }

  /** Centres of the spheres (m) at a time (s). */
  centres(t: number) {
    const count = 3 * this.scene.spheres.length;
    return this.broken ? new Float64Array(count) : this.instance.doubles(this.call('centres', t), count).slice();
  }

  /** Present energies and their balance; null for first-order scenes. */
  get energy(): Energies|null {
    const at = this.broken ? 0 : this.call('energies');
    if (!at) return null;
    const [kinetic, elastic, gravitational, , , , , , balance] = this.instance.doubles(at, 9);
    return {kinetic, elastic, gravitational, total: kinetic + elastic + gravitational, balance};
  }

  /**
   * Growing mode of a failed run, with a longest arrow of 1. If the run failed late, its last finite velocities replace
   * the mode, because repeating the run would delay a frame.
   */
  get growth() {
    if (this.going || this.verdict === 'ok' || this.scene.firstOrder) return null;
    this.grown ??= this.growingMode(growthBudget).mode ??
        longestOne(this.velocities.every(Number.isFinite) ? this.velocities : this.last.velocities);
    return this.grown;
  }

  /**
   * Repeats the run on a copy, and returns the change of velocities in one step, and the positions after that step. The
   * step is the last one before the change moves a particle by a tenth of the shortest spring per step, because later
   * growth is not linear. `mode` is null if the search exceeds the budget (ms).
   */
  growingMode(budget = Infinity) {
    const until = performance.now() + budget;
    const {rule, step, tolerance, duration} = this.run, [stepper, ...options] = rule.split('+');
    const twin = this.lab.open(this.sceneText()), small = 0.1 * this.scene.rests.reduce((a, b) => Math.min(a, b));
    let mode: Float64Array|null = null, before: Float64Array|null = null, places = this.last.positions;
    twin.start({stepper, options: options.map(word => `+${word}`).join(''), step, tolerance, duration, observe: false});
    for (let going = true, count = 0; going && count < 20000; ++count) {
      going = twin.advance(twin.t + 0.5 * step);
      const now = twin.velocities.slice(), was: Float64Array|null = before;
      const change: Float64Array|null = was && now.map((v, i) => v - was[i]);
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

  /** 16 hexadecimal digits: a hash of the bits of positions and velocities. */
  fingerprint() { return this.instance.text(this.call('fingerprint')); }

  // Changes by hand: the run continues in a new scene that begins in the present state.

  hold(particle: number, [x, y, z]: Vec3) { this.change('hold', particle, x, y, z); }
  release() { this.change('release'); }
  pin(particle: number, pinned: boolean) { this.change('set_pinned', particle, Number(pinned)); }

  private change(name: string, ...values: number[]) {
    this.call(name, ...values);
    this.byHand = true;
    this.going = true;
    this.failure = this.grown = this.fastest = null;
    this.limits.clear();
    this.remember();
    this.begun = {...this.last, centres: this.centres(0)};
    const {pinCount}: SceneHead = JSON.parse(this.instance.text(this.call('scene')));
    this.scene.pins = this.instance.integers(this.call('pins'), pinCount).slice();
  }

  /**
   * The present scene, with the run's method and step; changes by hand are in [start]. From this text, the command
   * line computes the same bits.
   */
  sceneText() {
    const {rule, step, tolerance} = this.run, adaptive = this.lab.stepperOf(rule)?.adaptive;
    const own = withMethod(this.toml, adaptive ? {method: rule, tolerance} : {method: rule, step});
    return this.begun ? withStart(own, this.scene.pins, this.begun) : own;
  }

  close() { this.broken = true; }
}
