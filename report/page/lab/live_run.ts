// Runs of the engine in this page: a method's own, and the truth beside it.
// @ts-nocheck

import {trailPoints} from './live_stage';

/** A method as the engine's start() takes it: stepper and options. */
export function startOf({method, step, tolerance}, duration, observe) {
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

/**
 * The places at a time between two states: the cubic through both with their velocities, a line where there are none.
 */
function between(from, to, t, into) {
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

/** RMS distance of the particles of two sets of places, m. */
export function rmsDistance(a, b) {
  let sum = 0;
  for (let i = 0; i < a.length; ++i) sum += (a[i] - b[i]) ** 2;
  return Math.sqrt(sum / (a.length / 3));
}

export const isFinite3 = places => {
  let sum = 0;
  for (let i = 0; i < places.length; ++i) sum += places[i];
  return Number.isFinite(sum);
};

/**
 * One method's run, with what it has come to as samples: {t, error, bar, kinetic, elastic, gravitational, total,
 * residual}.
 */
export class LiveRun {
  /**
   * Throws the engine's LabError where the scene is not read; a refused method leaves `refusal` instead. `observe` says
   * of a scene whether its energy balance is kept.
   */
  constructor(lab, toml, letter, spec, observe) {
    const sim = lab.open(toml);
    Object.assign(this, {letter, spec, sim, observe: observe(sim.scene)});
    this.stepper = lab.steppers.find(s => s.name === spec.method.split('+')[0]);
    this.start();
  }

  start(spec = this.spec) {
    Object.assign(this, {
      spec,
      samples: [],
      trail: [],
      recent: [],
      bursting: false,
      lost: 0,
      shown: false,
      offset: 0,
      spent: 0,
      stepped: 0,
      last: 0,
      refusal: null,
      fault: null,
      scale: 0,
      since: 0
    });
    try {
      this.sim.start(startOf(spec, this.sim.scene.duration, this.observe));
      this.keepPlaces();
      this.begin();
    } catch (problem) {
      this.refusal = problem.message;
      this.sim = this.sim.lab.open(
          this.sim.toml);  // an exception ends the instance, but its scene and limits are still needed
    }
    const {limit} = this;
    this.trails = !this.sim.scene.triangles.length;
    this.past = !this.refusal && limit !== null && this.sim.h > limit;
  }

  /** What the balance of a run that starts here is measured from. */
  begin() { this.first = this.sim.energy; }

  get time() { return this.offset + (this.refusal ? 0 : this.sim.t); }  // s
  get ended() { return Boolean(this.refusal || this.fault || this.sim.ended); }
  get verdict() { return this.fault ? 'solver' : this.refusal ? 'unsupported' : this.sim.verdict; }
  get failed() { return !this.refusal && this.verdict !== 'ok'; }
  get reason() { return this.refusal ?? this.fault ?? this.sim.reason; }
  get limit() { return this.sim.limit(this.stepper?.name ?? this.spec.method); }

  /**
   * Takes the steps that end by a time (s), as far as so many ms of computing allow; false where they do not suffice.
   */
  advance(time, budget) {
    this.last = 0;
    if (this.ended) return true;
    const from = this.time, begin = performance.now(), {sim} = this, last = time >= this.end - 1e-9;
    const h = sim.h || 0, aim = time - this.offset - (last ? 1e-6 : 1 - 1e-6) * h;
    if (sim.t >= aim) return true;
    try {
      // beyond the critical step each step is looked at: once the balance is lost quickly, a frame shows one step
      if (this.past) {
        while (!sim.ended && sim.t < aim && performance.now() - begin < budget) {
          sim.advance(sim.t + 0.5 * h, budget);
          this.keepPlaces();
          const residual = this.residual();
          this.bursting = residual > Math.max(0.01, 1.1 * this.lost);
          this.lost = residual;
          if (this.bursting) break;
        }
      } else if (this.trails) {
        // small scenes leave a trail, which has its own times
        const piece = sim.scene.duration / (trailPoints - 1);
        for (let to = sim.t + piece; !sim.ended && sim.t < aim && performance.now() - begin < budget;
             to = Math.max(to, sim.t) + piece) {
          sim.advance(Math.min(aim, to), budget);
          this.keepPlaces();
        }
      } else
        sim.advance(aim, budget);
    } catch (problem) {
      this.fault = problem.message;
    }
    this.last = performance.now() - begin;
    this.spent += this.last, this.stepped += this.fault ? 0 : this.time - from;
    if (!this.past && !this.trails) this.keepPlaces();
    return this.ended || (!this.bursting && sim.t >= aim - 1e-9 * (h || 1));
  }

  /** Time at which the run will have ended, s. */
  get end() { return this.offset + this.sim.scene.duration; }

  /** Keeps the last places that are numbers. */
  keepPlaces() {
    if (this.fault) return;
    const {positions} = this.sim;
    if (!isFinite3(positions)) return;
    if (this.places?.length !== positions.length) this.places = new Float64Array(positions.length);
    this.places.set(positions);
    this.recent.push(Float64Array.from(positions));
    if (this.recent.length > 24) this.recent.shift();
    // the way of the last particle, at even times
    if (this.trail.length <= (this.time - this.since) / this.sim.scene.duration * (trailPoints - 1))
      this.trail.push([...positions.slice(-3)]);
  }

  /** Real time over computing time, of the whole run so far. */
  get factor() { return this.spent > 0 ? 1000 * this.stepped / this.spent : null; }

  /** After a failure: the last places that `good` finds fit to be shown. */
  stepBack(good) {
    const found = this.recent.findLast(good);
    if (found) this.places.set(found);
  }

  /** The relative energy residual now; 0 where none is known. */
  residual(energy = this.sim.energy) {
    if (!energy || !this.first || !Number.isFinite(energy.balance)) return 0;
    const {kinetic, elastic, gravitational, balance} = energy, {first} = this;
    this.scale =
        Math.max(this.scale, kinetic, Math.abs(gravitational - first.gravitational), Math.abs(elastic - first.elastic));
    return this.scale > 0 ? Math.abs(balance - first.balance) / this.scale : 0;
  }

  /** Adds a sample of the present state. */
  sample(error, bar) {
    if (this.fault || this.refusal) return;
    const {
        energy} = this.sim,
       row = {t: this.time, error, bar, total: null, kinetic: null, elastic: null, gravitational: null, residual: null};
    if (energy && this.first) {
      const {kinetic, elastic} = energy, gravitational = energy.gravitational - this.first.gravitational,
                      residual = this.residual(energy);
      Object.assign(row, {
        kinetic,
        elastic,
        gravitational,
        total: kinetic - this.first.kinetic + elastic - this.first.elastic + gravitational
      });
      if (Number.isFinite(energy.balance)) row.residual = residual;
    }
    this.samples.push(row);
  }

  /** A change by hand: the engine goes on as a new scene whose clock starts at 0. */
  change(act) {
    const time = this.time;
    act(this.sim);
    this.offset = time - this.sim.t;
    this.since = time, this.trail = [];
    this.keepPlaces();
    this.begin();
  }

  /** What a distance from the truth is called: where balls are touched the truth is that of the same contact rule. */
  get errorWord() { return this.sim.scene.spheres.length ? 'difference' : 'error'; }

  close() { this.sim.close(); }
}

/** A run that is asked for its places at given times, each later than the one before. */
class Follower {
  constructor(lab, toml, spec, offset) {
    this.sim = lab.open(toml);
    this.sim.start(startOf(spec, this.sim.scene.duration, false));
    Object.assign(
        this, {spec, offset, spent: 0, stepped: 0, before: null, out: new Float64Array(this.sim.positions.length)});
    this.now = this.state();
  }

  state() {
    const {sim} = this;
    return {t: this.offset + sim.t, x: Float64Array.from(sim.positions), v: Float64Array.from(sim.velocities ?? [])};
  }

  /** Places at a time; null where they are not there within so many ms. */
  placesAt(time, budget) {
    const {sim} = this, h = sim.h || this.spec.step, begin = performance.now(), from = this.now.t;
    const tiny = 1e-6 * h, left = () => budget - (performance.now() - begin);
    if (this.now.t < time - tiny) {
      // up to the last step before the time, then over it
      if (this.now.t < time - h - tiny) sim.advance(time - this.offset - h - tiny, budget);
      this.before = this.state();
      if (!sim.ended && this.before.t < time - tiny && left() > 0) sim.advance(time - this.offset - tiny, left());
      this.now = this.before.t < time - tiny ? this.state() : this.before;
    }
    this.spent += performance.now() - begin, this.stepped += this.now.t - from;
    // states before the last step are not kept
    if (this.now.t < time - tiny || (this.before && time < this.before.t - tiny)) return null;
    return between(this.before ?? this.now, this.now, time, this.out);
  }

  close() { this.sim.close(); }
}

/**
 * The truth: a rule of order four at a quarter of its critical step, and once more at half of it, whose difference is
 * the error bar. Its steps divide those of the first method, so that their times meet.
 */
export class Truth {
  constructor(lab, toml, run, contact) {
    const {h} = run.sim, offset = run.offset, step = h || run.spec.step;
    const finest = (name, limit, part) => {
      const aim = Math.min(
          step, Number.isFinite(limit) && limit > 0 ? part * limit : step / (run.sim.scene.firstOrder ? 20 : 4));
      return step / (2 * Math.ceil(step / aim / 2 - 1e-9));
    };
    this.followers = [];
    for (const name of ['suzuki4', 'rk4', run.spec.method]) {
      const same = name === run.spec.method && name !== 'suzuki4' && name !== 'rk4';
      const spec = {method: name, step: same ? step / 100 : finest(name, run.sim.limit(name), 0.25)};
      try {
        this.followers = [new Follower(lab, toml, spec, offset)];
      } catch {
        continue;
      }
      Object.assign(this, {spec, same, order: same ? 0 : 4});
      break;
    }
    if (!this.followers.length) return;
    this.whole = contact || this.same;
    this.followers.push(new Follower(lab, toml, {...this.spec, step: 2 * this.spec.step}, offset));
  }

  get known() { return this.followers.length > 0; }
  get places() { return this.followers[0].out; }

  /** Error and error bar of places at a time, m; null where the truth is not there within so many ms. */
  compare(places, time, budget) {
    const begin = performance.now(), [fine, coarse] = this.followers, truth = fine.placesAt(time, budget);
    if (!truth || !isFinite3(truth)) return null;
    const check = coarse?.placesAt(time, Math.max(1, budget - (performance.now() - begin)));
    const bar = check ? rmsDistance(truth, check) * (this.whole ? 1 : 3 / 15) : null;
    return {error: rmsDistance(places, truth), bar};
  }

  /** Whether a time is still to come for the truth. */
  isBefore(time) {
    const {now, sim} = this.followers[0];
    return !sim.ended && now.t < time - 1e-6 * (sim.h || 1);
  }

  /** Computing for a second of the scene, ms. */
  get cost() { return this.followers.reduce((sum, {spent, stepped}) => sum + (stepped > 0 ? spent / stepped : 0), 0); }

  /** Gives up the error bar, then all; false when nothing is left. */
  shed() {
    this.followers.pop()?.close();
    return this.known;
  }

  close() {
    for (const each of this.followers) each.close();
  }
}
