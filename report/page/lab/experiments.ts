// The guided experiments: the lab's state in each step, when the step is done, and the numbers of its reason. Words are
// in words/ under EXPERIMENT.STEP.*; all numbers of results are read from the lab.

import {Places} from '../player/vectors';

import {Energies, labModule, Simulation} from './engine';
import {msText} from './knobs';
import {Changes, MethodSpec} from './scene_text';

/** A run of the lab now. */
interface RunReading {
  method: string;
  step: number;   // s
  limit: number;  // predicted critical step, s; 0 where none is known
  t: number;      // s
  steps: number;
  ended: boolean;
  failed: boolean;
  energy: Energies|null;
  gain: number|null;  // energy since the start that nothing explains, J
  x: Float64Array;    // places, m
  sim: Simulation;
}

/** The lab now. */
export interface Reading {
  scene: string;
  toml: string;
  runs: RunReading[];
  t: number;         // s
  duration: number;  // s
  omega: number;     // rad/s
  particles: number;
  columns: number;  // particles along a cloth; 0 elsewhere
  rows: number;
  at(path: string): number;
  vector(path: string): number[];
}

/** The lab as it was beside the question. */
export interface Before {
  limit: number;
  omega: number;
  particles: number;
  k: number;
  bend: number;
  mass: number;
  friction: number;
  angle: number;
  centre: number[];
}

type Memory = Record<string, number>;
/** What was seen in a step: before the guess, in all runs, and in the present run. */
export interface Seen {
  before: Before;
  all: Memory;
  run: Memory;
}

/** A state of the lab: numbers in the scene's own text, a further edit of it, the camera. */
export interface GuideState {
  scene: string;
  numbers: Changes;
  methods: MethodSpec[];
  edit?: (toml: string) => string;
  speed?: number;
  from?: {yaw: number, pitch: number, zoom: number};
}
export type Wanted = GuideState|((r: Reading, seen: Seen) => GuideState);
type Values = Record<string, string|number>;

export interface GuideStep {
  name: string;
  choices?: string[];
  right?: string;
  guess?: {unit: string, within: number, read: (r: Reading) => number};  // a number in place of choices
  start: GuideState;                                                     // beside the question
  then?: Wanted;                                                         // after the guess; default: start
  acts?: Wanted[];  // do the task for the reader, each run until it ends or is `enough`
  enough?: (r: Reading) => boolean;
  watch?: (r: Reading, seen: Seen) => void;  // keeps what matters of each reading
  done: (r: Reading, seen: Seen) => boolean;
  shown?: (seen: Seen) => Values;  // numbers in question and task
  values: (r: Reading, seen: Seen) => Values | Promise<Values>;
  arrows?: (r: Reading) => Promise<Mode>;  // a motion that the lab shows in the end
}

export interface GuideExperiment {
  name: string;
  scenes: string[];
  steps: GuideStep[];
}

/** A growing motion, the places that it is seen at, and how long its longest arrow is, m. */
export interface Mode {
  mode: Float64Array;
  places: Float64Array;
  by: number;
}

// Geometry

/** Distance of the first particle from the origin, m. */
const radiusOf = (x: ArrayLike<number>) => Math.hypot(x[0], x[1], x[2]);

export const centreOf = (x: Places) => [0, 1, 2].map(k => {
  let sum = 0;
  for (let i = k; i < x.length; i += 3) sum += x[i];
  return 3 * sum / x.length;
});

/** The sharpest fold along the rows and columns of a cloth, degrees: 0 where it is flat. */
function sharpestFold(x: Places, columns: number, rows: number) {
  let least = 1;
  const fold = (p: number, q: number, r: number) => {
    let both = 0, first = 0, second = 0;
    for (let k = 0; k < 3; ++k) {
      const a = x[3 * q + k] - x[3 * p + k], b = x[3 * r + k] - x[3 * q + k];
      both += a * b, first += a * a, second += b * b;
    }
    least = Math.min(least, both / Math.sqrt(first * second));
  };
  for (let j = 0; j < rows; ++j)
    for (let i = 0; i < columns; ++i) {
      const at = j * columns + i;
      if (i + 2 < columns) fold(at, at + 1, at + 2);
      if (j + 2 < rows) fold(at, at + columns, at + 2 * columns);
    }
  return Math.acos(Math.max(-1, least)) * 180 / Math.PI;
}

/** Share of the pairs of particles two cells apart that move against each other, weighted by how much they move. */
function opposedPart(mode: Float64Array, columns: number, rows: number) {
  let against = 0, all = 0;
  const pair = (p: number, q: number) => {
    const both = [0, 1, 2].reduce((sum, k) => sum + mode[3 * p + k] * mode[3 * q + k], 0);
    all += Math.abs(both);
    if (both < 0) against -= both;
  };
  for (let j = 0; j < rows; ++j)
    for (let i = 0; i < columns; ++i) {
      if (i + 2 < columns) pair(j * columns + i, j * columns + i + 2);
      if (j + 2 < rows) pair(j * columns + i, (j + 2) * columns + i);
    }
  return against / all;
}

/** Factor by which leapfrog multiplies a vibration in a step of h omega = a; 1 up to 2. */
const leapfrogFactor = (a: number) => (a <= 2 ? 1 : (a / 2 + Math.sqrt(a * a / 4 - 1)) ** 2);
/** Factor by which RK4 multiplies a radius. */
const rk4Factor = (a: number) => Math.sqrt(1 - a ** 6 / 72 + a ** 8 / 576);

// Numbers as text

const digits = (value: number, count = 3) => (value < 0 ? '−' : '') + Number(Math.abs(value).toPrecision(count));
const timeText = (time: number) => `${Number(time.toPrecision(3))} s`;
const degrees = (value: number) => String(Math.round(value));

// Readings

const runOfMethod = (r: Reading, method: string) => r.runs.find(run => run.method === method);
const finished = (run?: RunReading) => Boolean(run?.ended && !run.failed);
const holds = (run: RunReading, time: number) => !run.failed && run.t >= time;
const farthest = (seen: Memory, name: string, value: number) => (seen[name] = Math.max(seen[name] ?? -Infinity, value));
const nearest = (seen: Memory, name: string, value: number) => (seen[name] = Math.min(seen[name] ?? Infinity, value));

// States: a scene with other numbers and the methods in it. With one sample any step may be taken.

type Row = [method: string, step: number];
const state = (scene: string, numbers: Changes, ...methods: Row[]): GuideState =>
    ({scene, numbers: {'time.samples': 1, ...numbers}, methods: methods.map(([method, step]) => ({method, step}))});
const circle = (numbers: Changes, ...methods: Row[]) => ({...state('circle', numbers, ...methods), speed: 2});
const pendulum = (...methods: Row[]) => state('pendulum', {'time.samples': 200}, ...methods);
const hangingCloth = (step: number, numbers: Changes = {}) => state('cloth-hang', numbers, ['leapfrog', step]);
/** The same in slow motion: a burst takes less than a tenth of a second. */
const slowly = (speed: number, what: GuideState) => ({...what, speed});
/** The same from above, where motions within the cloth are seen. */
const fromAbove = (what: GuideState) => ({...what, from: {yaw: 0, pitch: 1.3, zoom: 0.75}});
const allSprings = (k: number) =>
    ({'grid.stiffness.structural': k, 'grid.stiffness.shear': k, 'grid.stiffness.bend': k});
const slowCircle = {}, fastCircle = {
  'rotation.rate': 4,
  'time.duration': Math.PI,
  'time.window': Math.PI
};
// its own step says how far the step's slider reaches
const longCircle = {
  'rotation.rate': 4,
  'time.duration': 8,
  'time.window': 8,
  'time.step': 0.3
};

const watchFold = (r: Reading, seen: Seen) => {
  const [run] = r.runs;
  if (r.columns && !run.failed) farthest(seen.run, 'fold', sharpestFold(run.x, r.columns, r.rows));
};
const foldValues = (r: Reading, seen: Seen) =>
    ({fold: degrees(seen.run.fold), centre: digits(-centreOf(r.runs[0].x)[1])});

/** Keeps the smallest step that failed and the largest that held for half a second. */
const watchSteps = (r: Reading, {all}: Seen) => {
  const [run] = r.runs;
  if (run.failed)
    nearest(all, 'burst', run.step);
  else if (run.t >= 0.5)
    farthest(all, 'held', run.step);
};

/** Angle from the top at which a particle starts on a ball, rad. */
export const startAngle = (r: Reading) => {
  const [x, y] = r.vector('particle.position');
  return Math.atan2(x, y);
};
const resting = (friction: number) => state(
    'slide', {
      'time.samples': 100,
      'particle.position': [0.51, 1.02 * Math.cos(Math.PI / 6), 0],  // 30 degrees from the top
      'particle.velocity': [0, 0, 0],
      'sphere.friction': friction
    },
    ['leapfrog', 1e-3]);
const slidingCloth = (friction: number) =>
    state('cloth-sphere', {'time.samples': 150, 'sphere.friction': friction}, ['leapfrog', 1e-3]);

/** Where the particle of `slide` has its last contact: the same run once more, looked at after every step. */
async function lastContact(r: Reading) {
  const [run] = r.runs, sim = (await labModule())!.open(r.toml), reach = r.at('sphere.radius') + r.at('sphere.margin');
  const last = {angle: 0, v: 0, r: 0};
  sim.start({stepper: run.method, step: run.step, duration: r.duration, observe: false});
  for (let going = true; going;) {
    const x = Array.from(sim.positions), v = Array.from(sim.velocities);
    if (radiusOf(x) > reach + 1e-10) break;
    Object.assign(last, {angle: Math.atan2(x[0], x[1]), v: Math.hypot(...v), r: radiusOf(x)});
    going = sim.advance(sim.t + 0.5 * run.step, 10);
  }
  sim.close();
  return last;
}

/** The hanging cloth with twice as many particles along each side; its pins stay at the corners. */
function finerCloth(toml: string) {
  const [, columns, rows] = (/^size = \[(\d+), (\d+)\]/m.exec(toml) ?? []).map(Number);
  return toml.replace(/^size = .*$/m, `size = [${2 * columns}, ${2 * rows}]`)
      .replace(/^particles = .*$/m, `particles = [0, ${2 * columns - 1}]`);
}

/** The mode that grows in the lab's run A. */
async function growingMode(r: Reading): Promise<Mode> {
  const {mode, places} = r.runs[0].sim.growingMode();
  return {mode: mode ?? new Float64Array(places.length), places, by: 0.7 * Math.min(...r.runs[0].sim.scene.rests)};
}

export const labExperiments: GuideExperiment[] = [
  {
    name: 'cloth-bursts',
    scenes: ['cloth-hang'],
    steps: [
      {
        name: 'past',
        choices: ['inexact', 'slow', 'bursts'],
        right: 'bursts',
        start: slowly(0.1, hangingCloth(1e-3)),
        acts: [r => slowly(0.1, hangingCloth(1.03 * r.runs[0].limit))],
        shown: ({before}) =>
            ({particles: before.particles, omega: digits(before.omega, 4), limit: msText(before.limit)}),
        done: r => Boolean(r.runs[0].failed && r.runs[0].step > r.runs[0].limit),
        values: r => {
          const {step, t, steps} = r.runs[0], a = step * r.omega, factor = leapfrogFactor(a);
          return {
            h: msText(step),
            product: digits(a),
            factor: digits(factor),
            t: timeText(t),
            n: steps,
            power: Math.round(steps * Math.log10(factor))
          };
        }
      },
      {
        name: 'mode',
        choices: ['swing', 'folds', 'zigzag'],
        right: 'zigzag',
        start: fromAbove(slowly(0.05, hangingCloth(1e-3))),
        acts: [r => fromAbove(slowly(0.05, hangingCloth(1.05 * r.runs[0].limit)))],
        done: r => Boolean(r.runs[0].failed && r.runs[0].step > r.runs[0].limit && r.columns),
        arrows: growingMode,
        values: async r => ({
          percent: Math.round(100 * opposedPart((await growingMode(r)).mode, r.columns, r.rows)),
          period: msText(2 * Math.PI / r.omega),
          limit: msText(r.runs[0].limit)
        })
      },
      {
        name: 'softer',
        choices: ['half', 'same', 'twice', 'four'],
        right: 'twice',
        start: hangingCloth(1e-3),
        then: (_, {before}) => hangingCloth(1e-3, allSprings(before.k / 4)),
        acts: [(_, {before}) => hangingCloth(1.9 * before.limit, allSprings(before.k / 4))],
        shown: ({before}) => ({kBefore: before.k, k: before.k / 4, limitBefore: msText(before.limit)}),
        done: (r, {before}) => {
          const [run] = r.runs;
          return r.at('grid.stiffness.structural') < before.k && run.step >= 1.795 * before.limit && holds(run, 0.5);
        },
        values: (r, {before}) => ({
          omegaBefore: digits(before.omega, 4),
          omega: digits(r.omega, 4),
          limitBefore: msText(before.limit),
          limit: msText(r.runs[0].limit),
          h: msText(r.runs[0].step)
        })
      },
      {
        name: 'heavier',
        guess: {unit: 'ms', within: 0.1, read: r => 1000 * r.runs[0].limit},
        start: hangingCloth(1e-3),
        then: (_, {before}) => hangingCloth(1e-3, {'grid.mass': 4 * before.mass}),
        acts: [
          (r, {before}) => hangingCloth(1.04 * r.runs[0].limit, {'grid.mass': 4 * before.mass}),
          (r, {before}) => hangingCloth(0.96 * r.runs[0].limit, {'grid.mass': 4 * before.mass})
        ],
        enough: r => r.runs[0].t >= 0.5,
        shown: ({before}) =>
            ({k: before.k, limitBefore: msText(before.limit), massBefore: before.mass, mass: 4 * before.mass}),
        watch: (r, seen) => {
          if (r.at('grid.mass') === 4 * seen.before.mass) watchSteps(r, seen);
        },
        done: (r, seen) => r.at('grid.mass') === 4 * seen.before.mass && seen.all.burst > seen.all.held &&
            seen.all.burst <= 1.115 * seen.all.held,
        values: (r, seen) => ({
          burst: msText(seen.all.burst),
          held: msText(seen.all.held),
          omega: digits(r.omega, 4),
          limit: msText(r.runs[0].limit)
        })
      },
      {
        name: 'finer',
        choices: ['twice', 'same', 'half'],
        right: 'half',
        start: hangingCloth(1e-3),
        then: () => ({...hangingCloth(1e-3), edit: finerCloth}),
        acts: [r => ({...hangingCloth(0.95 * r.runs[0].limit), edit: finerCloth})],
        enough: r => r.runs[0].t >= 0.5,
        shown: ({before}) => ({massBefore: before.mass}),
        done: (r, {before}) => r.particles > 2 * before.particles && holds(r.runs[0], 0.5),
        values: (r, {before}) =>
            ({omega: digits(r.omega, 4), limit: msText(r.runs[0].limit), ratio: digits(r.runs[0].limit / before.limit)})
      }
    ]
  },
  {
    name: 'euler-circle',
    scenes: ['circle'],
    steps: [
      {
        name: 'tangent',
        choices: ['outside', 'on', 'inside'],
        right: 'outside',
        start: circle(slowCircle, ['explicit-euler', 0.1]),
        done: r => finished(runOfMethod(r, 'explicit-euler')),
        values: r => {
          const {step, steps, x} = runOfMethod(r, 'explicit-euler')!, a = step * r.at('rotation.rate');
          return {
            n: steps,
            h: msText(step),
            predicted: digits((1 + a * a) ** (steps / 2), 4),
            radius: `${digits(radiusOf(x), 4)} m`
          };
        }
      },
      {
        name: 'half',
        choices: ['same', 'half', 'none'],
        right: 'half',
        start: circle(slowCircle, ['explicit-euler', 0.05], ['explicit-euler', 0.1]),
        done: r => r.runs.length === 2 && r.runs.every(run => run.method === 'explicit-euler' && finished(run)) &&
            r.runs[0].step < 0.6 * r.runs[1].step,
        values: ({runs: [fine, coarse]}) => ({
          fine: digits(radiusOf(fine.x) - 1),
          hFine: msText(fine.step),
          coarse: digits(radiusOf(coarse.x) - 1),
          hCoarse: msText(coarse.step)
        })
      },
      {
        name: 'mean',
        choices: ['far', 'hardly', 'never'],
        right: 'hardly',
        start: circle(slowCircle, ['explicit-euler', 0.1], ['trapezoidal', 0.1]),
        done: r => finished(runOfMethod(r, 'explicit-euler')) && finished(runOfMethod(r, 'trapezoidal')),
        values: r => {
          const {step, steps, x} = runOfMethod(r, 'trapezoidal')!, a = step * r.at('rotation.rate');
          return {
            n: steps,
            h: msText(step),
            radius: digits(radiusOf(x), 6),
            predicted: digits((1 + a ** 4 / 4) ** (steps / 2), 6),
            euler: digits(radiusOf(runOfMethod(r, 'explicit-euler')!.x), 4)
          };
        }
      },
      {
        name: 'faster',
        choices: ['same', 'half', 'quarter'],
        right: 'quarter',
        start: circle(fastCircle, ['explicit-euler', 0.1]),
        acts: [circle(fastCircle, ['explicit-euler', 0.025])],
        done: r => {
          const run = runOfMethod(r, 'explicit-euler');
          return Boolean(run && r.at('rotation.rate') === 4 && finished(run) && radiusOf(run.x) < 1.9);
        },
        values: r => {
          const {step, x} = runOfMethod(r, 'explicit-euler')!, omega = r.at('rotation.rate');
          return {h: msText(step), omega, product: digits(step * omega), radius: digits(radiusOf(x), 4)};
        }
      },
      {
        name: 'largest',
        choices: ['never', 'some', 'always'],
        right: 'some',
        start: circle(longCircle, ['rk4', 0.6]),
        acts: [circle(longCircle, ['rk4', 0.73])],
        done: r => {
          const run = runOfMethod(r, 'rk4');
          return Boolean(
              run && rk4Factor(run.step * r.at('rotation.rate')) > 1 && (run.failed || radiusOf(run.x) > 1.5));
        },
        values: r => {
          const {step} = runOfMethod(r, 'rk4')!, omega = r.at('rotation.rate');
          return {
            omega,
            limit: msText(2 * Math.SQRT2 / omega),
            h: msText(step),
            factor: digits(rk4Factor(step * omega))
          };
        }
      }
    ]
  },
  {
    name: 'pendulum-energy',
    scenes: ['pendulum'],
    steps: [
      {
        name: 'explicit',
        choices: ['gains', 'keeps', 'loses'],
        right: 'gains',
        start: pendulum(['explicit-euler', 5e-3]),
        watch: (r, seen) => {
          const run = runOfMethod(r, 'explicit-euler');
          if (run && run.gain !== null && Number.isFinite(run.gain)) farthest(seen.run, 'gain', run.gain);
        },
        done: (r, seen) => {
          const run = runOfMethod(r, 'explicit-euler');
          return Boolean(run && (run.failed || run.ended) && seen.run.gain > 0);
        },
        values: (r, seen) => {
          const {step, t} = runOfMethod(r, 'explicit-euler')!, a = step * r.omega;
          return {
            omega: digits(r.omega),
            h: msText(step),
            percent: digits(100 * (Math.sqrt(1 + a * a) - 1), 2),
            t: timeText(t),
            energy: digits(seen.run.gain)
          };
        }
      },
      {
        name: 'implicit',
        choices: ['gains', 'keeps', 'loses'],
        right: 'loses',
        start: pendulum(['implicit-euler', 0.01]),
        watch: (r, seen) => {
          const run = runOfMethod(r, 'implicit-euler');
          if (!run?.energy) return;
          farthest(seen.run, 'top', run.energy.gravitational);
          nearest(seen.run, 'bottom', run.energy.gravitational);
        },
        done: r => finished(runOfMethod(r, 'implicit-euler')),
        values: (r, seen) => {
          const {t, gain} = runOfMethod(r, 'implicit-euler')!;
          return {t: timeText(t), energy: digits(-(gain ?? 0)), swing: digits(seen.run.top - seen.run.bottom, 2)};
        }
      },
      {
        name: 'leapfrog',
        choices: ['grows', 'falls', 'swings'],
        right: 'swings',
        start: pendulum(['leapfrog', 0.01]),
        watch: (r, seen) => {
          const run = runOfMethod(r, 'leapfrog');
          if (!run || run.gain === null) return;
          farthest(seen.run, 'high', run.gain);
          nearest(seen.run, 'low', run.gain);
        },
        done: r => finished(runOfMethod(r, 'leapfrog')),
        values: (r, seen) => {
          const {t, gain} = runOfMethod(r, 'leapfrog')!;
          return {
            t: timeText(t),
            low: digits(seen.run.low, 2),
            high: digits(seen.run.high, 2),
            end: digits(gain ?? 0, 2)
          };
        }
      },
      {
        name: 'which',
        choices: ['swing', 'spring', 'gravity'],
        right: 'spring',
        start: state('pendulum', {}, ['leapfrog', 0.06]),
        acts: [r => state('pendulum', {}, ['leapfrog', 1.1 * r.runs[0].limit])],
        shown: ({before}) => ({period: msText(2 * Math.PI / before.omega)}),
        done: r => {
          const run = runOfMethod(r, 'leapfrog');
          return Boolean(run?.failed && run.step > run.limit);
        },
        values: r => {
          const {step, limit, t} = runOfMethod(r, 'leapfrog')!;
          return {
            k: r.at('spring.stiffness'),
            m: r.at('particle.mass'),
            omega: digits(r.omega),
            limit: msText(limit),
            h: msText(step),
            t: timeText(t)
          };
        }
      }
    ]
  },
  {
    name: 'ball-friction',
    scenes: ['slide', 'cloth-sphere'],
    steps: [
      {
        name: 'sticky',
        choices: ['off', 'part', 'stays'],
        right: 'stays',
        start: state('slide', {'time.samples': 100}, ['leapfrog+sticky', 1e-3], ['leapfrog', 1e-3]),
        shown: ({before}) => ({mu: before.friction}),
        done: r => finished(runOfMethod(r, 'leapfrog+sticky')) && finished(runOfMethod(r, 'leapfrog')),
        values: r => {
          const home = r.vector('particle.position');
          const moved = ({x}: RunReading) => Math.hypot(...home.map((c, k) => x[k] - c));
          const free = runOfMethod(r, 'leapfrog')!;
          return {
            moved: digits(moved(runOfMethod(r, 'leapfrog+sticky')!)),
            away: digits(moved(free)),
            t: timeText(free.t)
          };
        }
      },
      {
        name: 'leaves',
        choices: ['early', 'middle', 'late'],
        right: 'middle',
        start: state('slide', {'time.samples': 100}, ['leapfrog', 1e-3]),
        shown: ({before}) => ({mu: before.friction}),
        done: (r, {before}) => {
          const [run] = r.runs;
          return r.at('sphere.friction') === before.friction && run.method === 'leapfrog' && !run.failed &&
              radiusOf(run.x) > 1.005 * (r.at('sphere.radius') + r.at('sphere.margin'));
        },
        values: async r => {
          const {angle, v, r: away} = await lastContact(r), g = r.at('gravity.acceleration');
          return {
            angle: digits(angle * 180 / Math.PI),
            v: digits(v),
            need: digits(v * v / away),
            have: digits(g * Math.cos(angle))
          };
        }
      },
      {
        name: 'cone',
        guess: {unit: 'μ', within: 0.1, read: r => Math.tan(startAngle(r))},
        start: resting(0.3),
        acts: [resting(0.55), resting(0.6)],
        shown: ({before}) => ({angle: degrees(before.angle * 180 / Math.PI)}),
        watch: (r, seen) => {
          const [run] = r.runs, home = r.vector('particle.position'), mu = r.at('sphere.friction');
          if (run.failed || Math.abs(startAngle(r) - seen.before.angle) > 1e-9) return;
          const moved = Math.hypot(...home.map((c, k) => run.x[k] - c));
          if (moved > 0.02)
            farthest(seen.all, 'slid', mu);
          else if (run.ended && moved < 0.002)
            nearest(seen.all, 'held', mu);
        },
        done: (_, {all}) => all.held > all.slid && all.held - all.slid < 0.1001,
        values: (r, seen) => ({
          angle: degrees(startAngle(r) * 180 / Math.PI),
          tangent: digits(Math.tan(startAngle(r))),
          held: seen.all.held,
          slid: seen.all.slid
        })
      },
      {
        name: 'cloth',
        choices: ['stays', 'slides', 'tears'],
        right: 'slides',
        start: slidingCloth(0.5),
        then: slidingCloth(0.1),
        shown: ({before}) => ({mu: before.friction, small: 0.1}),
        done: r => r.scene === 'cloth-sphere' && r.at('sphere.friction') <= 0.1 && finished(r.runs[0]),
        values: (r, {before}) => {
          const now = centreOf(r.runs[0].x),
                angle = Math.asin(before.centre[0] / (r.at('sphere.radius') + r.at('sphere.margin')));
          return {
            sideways: digits(now[0] - before.centre[0]),
            down: digits(before.centre[1] - now[1]),
            t: timeText(r.t),
            angle: degrees(angle * 180 / Math.PI),
            tangent: digits(Math.tan(angle), 2),
            mu: before.friction,
            small: r.at('sphere.friction')
          };
        }
      }
    ]
  },
  {
    name: 'bend-springs',
    scenes: ['cloth-hang'],
    steps: [
      {
        name: 'without',
        choices: ['lower', 'creases', 'nothing'],
        right: 'creases',
        start: hangingCloth(5e-4),
        then: hangingCloth(5e-4, {'grid.stiffness.bend': 0}),
        watch: watchFold,
        done: r => r.at('grid.stiffness.bend') === 0 && finished(r.runs[0]),
        values: foldValues
      },
      {
        name: 'with',
        choices: ['same', 'half', 'flat'],
        right: 'flat',
        start: hangingCloth(5e-4),
        shown: ({before}) => ({bend: before.bend}),
        watch: watchFold,
        done: (r, {before}) => r.at('grid.stiffness.bend') === before.bend && finished(r.runs[0]),
        values: foldValues
      },
      {
        name: 'price',
        choices: ['same', 'half', 'tenth'],
        right: 'half',
        start: hangingCloth(1e-3),
        then: (_, {before}) => hangingCloth(1e-3, {'grid.stiffness.bend': 10 * before.bend}),
        shown: ({before}) => ({bend: 10 * before.bend}),
        done: (r, {before}) => r.at('grid.stiffness.bend') >= 10 * before.bend && r.runs[0].failed,
        values: (r, {before}) => ({
          omegaBefore: digits(before.omega, 4),
          omega: digits(r.omega, 4),
          limitBefore: msText(before.limit),
          limit: msText(r.runs[0].limit)
        })
      },
      {
        name: 'enough',
        choices: ['half', 'fifth', 'tenth'],
        right: 'tenth',
        start: hangingCloth(5e-4, {'grid.stiffness.bend': 0}),
        acts: [(_, {before}) => hangingCloth(5e-4, {'grid.stiffness.bend': before.k / 10})],
        shown: ({before}) => ({k: before.k, most: before.k / 10}),
        watch: watchFold,
        done: (r, {before, run}) => {
          const bend = r.at('grid.stiffness.bend');
          return bend > 0 && bend <= before.k / 10 && finished(r.runs[0]) && run.fold < 30;
        },
        values: (r, seen) => ({
          bend: r.at('grid.stiffness.bend'),
          fold: degrees(seen.run.fold),
          limit: msText(r.runs[0].limit),
          without: msText(seen.before.limit)
        })
      }
    ]
  }
];
