// Runs of the engine in the page, and the truth.

import {placeOf, Places, Vec3} from '../player/vectors';

import {Energies, EngineScene, Lab, RunSettings, Simulation, solidsOf, Stepper} from './engine';
import {lookOfRun, RunLook} from './lab_view';
import {trailPoints} from './live_stage';
import {MethodSpec} from './scene_text';

export const messageOf = (problem: unknown) => problem instanceof Error ? problem.message : String(problem);

/** Settings of a method for the engine's start(). */
export function startOf({method, step, tolerance}: MethodSpec, duration: number, observe: boolean): RunSettings {
  const [stepper, ...options] = method.split('+');
  return {
    stepper,
    options: options.map(o => `+${o}`).join(''),
    step: step || undefined,
    tolerance: tolerance || 1e-6,
    duration,
    observe
  };
}

/** t in s. */
interface State {
  t: number;
  x: Float64Array;
  v: Float64Array;
}

/** Positions between two states: on a cubic through both, or on a straight line if velocities are missing. */
function between(from: State, to: State, t: number, into: Float64Array) {
  const h = to.t - from.t, u = h > 0 ? Math.min(1, Math.max(0, (t - from.t) / h)) : 1, a = from.x, b = to.x;
  if (u === 1)
    into.set(b);
  else if (from.v.length !== a.length)
    for (let i = 0; i < a.length; ++i) into[i] = a[i] + u * (b[i] - a[i]);
  else {
    const w = u * u * (3 - 2 * u), p = h * u * (1 - u) * (1 - u), q = h * u * u * (u - 1);
    for (let i = 0; i < a.length; ++i) into[i] = a[i] + w * (b[i] - a[i]) + p * from.v[i] + q * to.v[i];
  }
  return into;
}

export function rmsDistance(a: Places, b: Places) {
  let sum = 0;
  for (let i = 0; i < a.length; ++i) sum += (a[i] - b[i]) ** 2;
  return Math.sqrt(sum / (a.length / 3));
}

export const isFinite3 = (places: Places) => {
  let sum = 0;
  for (let i = 0; i < places.length; ++i) sum += places[i];
  return Number.isFinite(sum);
};

/** Values of a run at a time (s): error and its bar (m), energies (J), relative residual. */
export interface Sample {
  t: number;
  error: number|null;
  bar: number|null;
  total: number|null;
  kinetic: number|null;
  elastic: number|null;
  gravitational: number|null;
  residual: number|null;
}

export class LiveRun {
  readonly stepper: Stepper|undefined;
  sim: Simulation;
  look: RunLook;
  places: Float64Array|null = null;  // last finite positions
  samples: Sample[] = [];
  trail: Vec3[] = [];  // path of the last particle
  bursting = false;
  shown = false;                 // true once the failure has been shown
  offset = 0;                    // s, time at which the engine's clock was 0
  since = 0;                     // s, time of the last change by hand
  last = 0;                      // ms of computation in the last frame
  handWork: number|null = null;  // J, work done by the hand
  refusal: string|null = null;
  fault: string|null = null;
  first: Energies|null = null;  // energies at the start of the energy balance
  private readonly observe: boolean;
  private recent: Float64Array[] = [];
  private lost = 0;
  private spent = 0;    // ms
  private stepped = 0;  // s
  private scale = 0;    // J
  private trails = false;
  private past = false;  // true: the step exceeds the critical step

  /**
   * Throws LabError if the scene cannot be read. If the engine refuses the method, sets `refusal` instead. `observe`
   * decides whether the scene's energy balance is computed.
   */
  constructor(
      lab: Lab, toml: string, readonly letter: string, public spec: MethodSpec,
      observe: (scene: EngineScene) => boolean) {
    this.look = lookOfRun(letter);
    this.sim = lab.open(toml);
    this.observe = observe(this.sim.scene);
    this.stepper = lab.stepperOf(spec.method);
    this.start();
  }

  start() {
    this.samples = [], this.trail = [], this.recent = [];
    this.bursting = this.shown = false;
    this.lost = this.offset = this.since = this.spent = this.stepped = this.last = this.scale = 0;
    this.refusal = this.fault = this.handWork = null;
    try {
      this.sim.start(startOf(this.spec, this.sim.scene.duration, this.observe));
      this.keepPlaces();
      this.first = this.sim.energy;
    } catch (problem) {
      this.refusal = messageOf(problem);
      this.sim = this.sim.lab.open(this.sim.toml);  // replaces the ended instance, whose scene and limits are needed
    }
    const {limit} = this;
    this.trails = !this.sim.scene.triangles.length;
    this.past = !this.refusal && limit !== null && this.sim.h > limit;
  }

  get time() { return this.offset + (this.refusal ? 0 : this.sim.t); }  // s
  get ended() { return Boolean(this.refusal || this.fault || this.sim.ended); }
  get verdict() { return this.fault ? 'solver' : this.refusal ? 'unsupported' : this.sim.verdict; }
  get failed() { return !this.refusal && this.verdict !== 'ok'; }
  get reason() { return this.refusal ?? this.fault ?? this.sim.reason; }
  get limit() { return this.sim.limit(this.spec.method); }
  get lastSample(): Sample|undefined { return this.samples[this.samples.length - 1]; }
  /** Step of the run, s; before the start, the requested step. */
  get step() { return (this.refusal ? 0 : this.sim.h) || this.spec.step || this.sim.scene.step; }
  /** Time at which the run ends, s. */
  get end() { return this.offset + this.sim.scene.duration; }
  /** Simulated time / computing time, up to now. */
  get factor() { return this.spent > 0 ? 1000 * this.stepped / this.spent : null; }
  /** With balls or planes, the distance from the truth is not an error, because run and truth share a contact rule. */
  get errorWord() { return solidsOf(this.sim.scene) ? 'difference' : 'error'; }

  /** Steps up to a time (s), but computes for at most `budget` ms. Returns false if that is not enough. */
  advance(time: number, budget: number) {
    this.last = 0;
    if (this.ended) return true;
    const from = this.time, begin = performance.now(), {sim} = this, last = time >= this.end - 1e-9;
    const h = sim.h || 0, aim = time - this.offset - (last ? 1e-6 : 1 - 1e-6) * h;
    const goes = () => !sim.ended && sim.t < aim && performance.now() - begin < budget;
    if (sim.t >= aim) return true;
    try {
      // beyond the critical step, observe each step, and show a quick failure one step per frame
      if (this.past) {
        while (goes()) {
          sim.advance(sim.t + 0.5 * h, budget);
          this.keepPlaces();
          const residual = this.residual();
          this.bursting = residual > Math.max(0.01, 1.1 * this.lost);
          this.lost = residual;
          if (this.bursting) break;
        }
      } else if (this.trails) {
        // the trail needs positions at its own times, between those of the frames
        const piece = sim.scene.duration / (trailPoints - 1);
        for (let to = sim.t + piece; goes(); to = Math.max(to, sim.t) + piece) {
          sim.advance(Math.min(aim, to), budget);
          this.keepPlaces();
        }
      } else
        sim.advance(aim, budget);
    } catch (problem) {
      this.fault = messageOf(problem);
    }
    this.last = performance.now() - begin;
    this.spent += this.last, this.stepped += this.fault ? 0 : this.time - from;
    if (!this.past && !this.trails) this.keepPlaces();
    return this.ended || (!this.bursting && sim.t >= aim - 1e-9 * (h || 1));
  }

  keepPlaces() {
    if (this.fault) return;
    const {positions} = this.sim;
    if (!isFinite3(positions)) return;
    if (this.places?.length !== positions.length) this.places = new Float64Array(positions.length);
    this.places.set(positions);
    this.recent.push(positions.slice());
    if (this.recent.length > 24) this.recent.shift();
    // the points of a trail are at equal time intervals
    if (this.trail.length <= (this.time - this.since) / this.sim.scene.duration * (trailPoints - 1))
      this.trail.push(placeOf(positions, positions.length / 3 - 1));
  }

  /** For failed runs: returns to the last positions that `good` accepts. */
  stepBack(good: (places: Float64Array) => boolean) {
    const found = [...this.recent].reverse().find(good);
    if (found) this.places?.set(found);
  }

  /** Present relative residual of the energy balance; 0 if unknown. */
  private residual(energy = this.sim.energy) {
    const {first} = this;
    if (!energy || !first || !Number.isFinite(energy.balance)) return 0;
    const {kinetic, elastic, gravitational, balance} = energy;
    this.scale =
        Math.max(this.scale, kinetic, Math.abs(gravitational - first.gravitational), Math.abs(elastic - first.elastic));
    return this.scale > 0 ? Math.abs(balance - first.balance) / this.scale : 0;
  }

  sample(error: number|null, bar: number|null) {
    if (this.fault || this.refusal) return;
    const {first, sim: {energy}} = this, none = null;
    const row: Sample =
        {t: this.time, error, bar, total: none, kinetic: none, elastic: none, gravitational: none, residual: none};
    if (energy && first) {
      const residual = this.residual(energy), {kinetic, elastic} = energy;
      const gravitational = energy.gravitational - first.gravitational, total = energy.total - first.total;
      Object.assign(row, {kinetic, elastic, gravitational, total});
      if (Number.isFinite(energy.balance)) row.residual = residual;
    }
    this.samples.push(row);
  }

  /** Applies a change by hand. The engine continues as a new scene whose clock starts at 0. */
  change(act: (sim: Simulation) => void) {
    const {time, sim} = this, before = sim.energy?.total;
    act(sim);
    const after = sim.energy?.total;
    if (before !== undefined && after !== undefined) this.handWork = (this.handWork ?? 0) + after - before;
    this.offset = time - sim.t;
    this.since = time, this.trail = [];
    this.keepPlaces();
    this.first = sim.energy;
  }

  close() { this.sim.close(); }
}

/** A run whose positions are read at increasing times. */
class Follower {
  readonly sim: Simulation;
  readonly out: Float64Array;
  spent = 0;    // ms
  stepped = 0;  // s
  now: State;
  private before: State|null = null;

  constructor(lab: Lab, toml: string, readonly spec: MethodSpec, private readonly offset: number) {
    this.sim = lab.open(toml);
    this.sim.start(startOf(spec, this.sim.scene.duration, false));
    this.out = new Float64Array(this.sim.positions.length);
    this.now = this.state();
  }

  get step() { return this.sim.h || this.spec.step || 0; }

  private state(): State {
    const {sim} = this;
    return {t: this.offset + sim.t, x: sim.positions.slice(), v: sim.velocities.slice()};
  }

  /** Positions at a time; null if they are not available within `budget` ms. */
  placesAt(time: number, budget: number) {
    const {sim} = this, h = this.step, begin = performance.now(), from = this.now.t;
    const tiny = 1e-6 * h, left = () => budget - (performance.now() - begin);
    if (this.now.t < time - tiny) {
      // advance to the last step before `time`, then beyond `time`
      if (this.now.t < time - h - tiny) sim.advance(time - this.offset - h - tiny, budget);
      this.before = this.state();
      if (!sim.ended && this.before.t < time - tiny && left() > 0) sim.advance(time - this.offset - tiny, left());
      this.now = this.before.t < time - tiny ? this.state() : this.before;
    }
    this.spent += performance.now() - begin, this.stepped += this.now.t - from;
    // earlier states are not available
    if (this.now.t < time - tiny || (this.before && time < this.before.t - tiny)) return null;
    return between(this.before ?? this.now, this.now, time, this.out);
  }

  close() { this.sim.close(); }
}

/**
 * The truth is computed by a fourth-order rule with at most a quarter of its critical step (if there is none: a quarter
 * of the run's step, or a twentieth for first-order scenes), and again with twice that step. If no fourth-order rule
 * supports the scene, the run's own stepper is used with a hundredth of its step. The error bar is 3 / (2^4 - 1) of the
 * difference between the two runs; with contact, or with the run's own stepper, it is the whole difference. Both steps
 * divide the step of the first method, so that the times coincide.
 */
export class Truth {
  spec: MethodSpec = {method: ''};
  same = false;  // true: the truth uses the run's own stepper, with a shorter step
  readonly followers: Follower[] = [];
  // true: the error bar is the whole difference of two runs; false: a fifth of it
  private readonly whole: boolean;

  constructor(lab: Lab, toml: string, run: LiveRun, contact: boolean) {
    const {offset, step, sim, spec: {method}} = run;
    const finest = (name: string) => {
      const limit = sim.limit(name), part = step / (sim.scene.firstOrder ? 20 : 4);
      const aim = Math.min(step, limit !== null && Number.isFinite(limit) && limit > 0 ? 0.25 * limit : part);
      return step / (2 * Math.ceil(step / aim / 2 - 1e-9));
    };
    for (const name of ['suzuki4', 'rk4', method]) {
      const same = name === method && name !== 'suzuki4' && name !== 'rk4';
      const spec = {method: name, step: same ? step / 100 : finest(name)};
      try {
        this.followers.push(new Follower(lab, toml, spec, offset));
      } catch {
        continue;
      }
      Object.assign(this, {spec, same});
      this.followers.push(new Follower(lab, toml, {...spec, step: 2 * spec.step}, offset));
      break;
    }
    this.whole = contact || this.same;
  }

  get known() { return this.followers.length > 0; }
  get places() { return this.followers[0].out; }
  get begun() { return this.followers[0].spent > 0; }

  /** Error and error bar (m) of positions; null if the truth is not available within `budget` ms. */
  compare(places: Places, time: number, budget: number) {
    const begin = performance.now(), [fine, coarse] = this.followers, truth = fine.placesAt(time, budget);
    if (!truth || !isFinite3(truth)) return null;
    const check = coarse?.placesAt(time, Math.max(1, budget - (performance.now() - begin)));
    const bar = check ? rmsDistance(truth, check) * (this.whole ? 1 : 3 / 15) : null;
    return {error: rmsDistance(places, truth), bar};
  }

  isBefore(time: number) {
    const {now, sim} = this.followers[0];
    return !sim.ended && now.t < time - 1e-6 * (sim.h || 1);
  }

  /** Computing time (ms) per second of the scene. */
  get cost() { return this.followers.reduce((sum, {spent, stepped}) => sum + (stepped > 0 ? spent / stepped : 0), 0); }

  /** Stops computing the error bar, and when called again, the truth. Returns false if nothing is left. */
  shed() {
    this.followers.pop()?.close();
    return this.known;
  }

  close() {
    for (const each of this.followers) each.close();
  }
}
