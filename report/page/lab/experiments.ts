// Guided experiments. Each step has states of the lab, a condition of completion, and numbers for the explanation.
// Texts are in words/ under EXPERIMENT.STEP.*.

import {Places} from '../player/vectors';

import {Energies, Simulation} from './engine';
import {msText} from './knobs';
import {Changes, MethodSpec} from './scene_text';

interface RunReading {
  method: string;
  step: number;   // s
  limit: number;  // predicted critical step, s; 0: unknown
  t: number;      // s
  steps: number;
  ended: boolean;
  failed: boolean;
  energy: Energies|null;
  gain: number;     // J, energy gained although there is no source; NaN: unknown
  x: Float64Array;  // positions, m
  sim: Simulation;
}

export interface Reading {
  scene: string;
  toml: string;
  run: RunReading;
  runs: RunReading[];
  t: number;         // s
  duration: number;  // s
  omega: number;     // rad/s
  particles: number;
  columns: number;  // particles along a cloth; 0 for other scenes
  rows: number;
  at(path: string): number;
  vector(path: string): number[];
}

/** State of the lab while the question is shown. */
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
/** Observations: before the guess, in all runs of a step, and in the present run. */
export interface Seen {
  before: Before;
  all: Memory;
  run: Memory;
}

/** A state of the lab: a scene, changed numbers of its text, a further edit of that text, the camera. */
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
  guess?: {unit: string, within: number, read: (r: Reading) => number};  // asks for a number, not for a choice
  start: GuideState;                                                     // state while the question is shown
  then?: Wanted;                                                         // state after the guess; default: start
  acts?: Wanted[];  // states that do the task for the reader; each lasts until its run ends or `enough` is true
  enough?: (r: Reading) => boolean;
  watch?: (r: Reading, seen: Seen) => void;  // records observations
  done: (r: Reading, seen: Seen) => boolean;
  // further numbers for the texts of the step
  shown?: (before: Before) => Values;           // for the question and the task
  values?: (r: Reading, seen: Seen) => Values;  // for the explanation
  arrows?: (r: Reading) => Mode;                // motion that is shown at the end
}

export interface GuideExperiment {
  name: string;
  scenes: string[];
  steps: GuideStep[];
}

/** A growing motion, the positions at which to draw it, and the length (m) of the longest arrow. */
export interface Mode {
  mode: Float64Array;
  places: Float64Array;
  by: number;
}


const radiusOf = (x: ArrayLike<number>) => Math.hypot(x[0], x[1], x[2]);

export const centreOf = (x: Places) => [0, 1, 2].map(k => {
  let sum = 0;
  for (let i = k; i < x.length; i += 3) sum += x[i];
  return 3 * sum / x.length;
});

/** Sharpest fold along rows and columns, degrees: 0 if the cloth is flat. */
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

/** Among pairs of particles two cells apart: the fraction that moves in opposite directions, weighted by motion. */
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

/** Amplification of a vibration per leapfrog step with h omega = a; 1 for a <= 2. */
const leapfrogFactor = (a: number) => (a <= 2 ? 1 : (a / 2 + Math.sqrt(a * a / 4 - 1)) ** 2);
/** Amplification of a radius per RK4 step with h omega = a. */
const rk4Factor = (a: number) => Math.sqrt(1 - a ** 6 / 72 + a ** 8 / 576);


const digits = (value: number, count = 3) => (value < 0 ? '−' : '') + Number(Math.abs(value).toPrecision(count));
const degrees = (value: number) => String(Math.round(value));


const finished = (run: RunReading|undefined, method = run?.method) =>
    Boolean(run?.ended && !run.failed && run.method === method);
const holds = (run: RunReading, time: number) => !run.failed && run.t >= time;
const farthest = (seen: Memory, name: string, value: number) => {
  if (Number.isFinite(value)) seen[name] = Math.max(seen[name] ?? -Infinity, value);
};
const nearest = (seen: Memory, name: string, value: number) => {
  if (Number.isFinite(value)) seen[name] = Math.min(seen[name] ?? Infinity, value);
};
/** Distance of the first particle from its initial position, m. */
const movedBy = (r: Reading, {x}: RunReading) => Math.hypot(...r.vector('particle.position').map((c, k) => x[k] - c));

// States of the lab: changed numbers of a scene, and methods. `time.samples = 1` allows any step.

type Row = [method: string, step: number];
const state = (scene: string, numbers: Changes, ...methods: Row[]): GuideState =>
    ({scene, numbers: {'time.samples': 1, ...numbers}, methods: methods.map(([method, step]) => ({method, step}))});
const circle = (numbers: Changes, ...methods: Row[]) => ({...state('circle', numbers, ...methods), speed: 2});
const pendulum = (...method: Row) => state('pendulum', {'time.samples': 200}, method);
const hangingCloth = (step: number, numbers: Changes = {}) => state('cloth-hang', numbers, ['leapfrog', step]);
const heavyCloth = (step: number, {mass}: Before) => hangingCloth(step, {'grid.mass': 4 * mass});
/** Makes a state run slowly, because a blow-up takes less than a tenth of a second. */
const slowly = (speed: number, what: GuideState) => ({...what, speed});
/** Shows a state from above, where motions within the cloth are visible. */
const fromAbove = (what: GuideState) => ({...what, from: {yaw: 0, pitch: 1.3, zoom: 0.75}});
const allSprings = (k: number) =>
    ({'grid.stiffness.structural': k, 'grid.stiffness.shear': k, 'grid.stiffness.bend': k});
const fastCircle = {
  'rotation.rate': 4,
  'time.duration': Math.PI,
  'time.window': Math.PI
};
// the scene's step determines the slider's range
const longCircle = {
  'rotation.rate': 4,
  'time.duration': 8,
  'time.window': 8,
  'time.step': 0.3
};

const watchFold = ({run, columns, rows}: Reading, seen: Seen) => {
  if (columns && !run.failed) farthest(seen.run, 'fold', sharpestFold(run.x, columns, rows));
};
const foldValues = ({run}: Reading, seen: Seen) =>
    ({fold: degrees(seen.run.fold), centre: digits(-centreOf(run.x)[1])});

/** Angle (rad) at which a particle starts, measured from the top of a ball. */
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

/**
 * Angle, speed and distance from the centre at the last contact in `slide`; repeats the run and observes every step.
 */
function lastContact({run, at, toml, duration}: Reading) {
  const sim = run.sim.lab.open(toml), reach = at('sphere.radius') + at('sphere.margin');
  const last = {angle: 0, v: 0, away: 0};
  sim.start({stepper: run.method, step: run.step, duration, observe: false});
  for (let going = true; going && radiusOf(sim.positions) <= reach + 1e-10;) {
    const [x, y] = sim.positions;
    Object.assign(last, {angle: Math.atan2(x, y), v: radiusOf(sim.velocities), away: radiusOf(sim.positions)});
    going = sim.advance(sim.t + 0.5 * run.step, 10);
  }
  sim.close();
  return last;
}

/** The hanging cloth with twice as many particles along each side; pins stay at the corners. */
function finerCloth(toml: string) {
  const [, columns, rows] = (/^size = \[(\d+), (\d+)\]/m.exec(toml) ?? []).map(Number);
  return toml.replace(/^size = .*$/m, `size = [${2 * columns}, ${2 * rows}]`)
      .replace(/^particles = .*$/m, `particles = [0, ${2 * columns - 1}]`);
}

function growingMode({run: {sim}}: Reading): Mode {
  const {mode, places} = sim.growingMode();
  return {mode: mode ?? new Float64Array(places.length), places, by: 0.7 * Math.min(...sim.scene.rests)};
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
        acts: [({run}) => slowly(0.1, hangingCloth(1.03 * run.limit))],
        done: ({run}) => run.failed && run.step > run.limit,
        values: ({run, omega}) => {
          const product = run.step * omega, factor = leapfrogFactor(product);
          return {product: digits(product), factor: digits(factor), power: Math.round(run.steps * Math.log10(factor))};
        }
      },
      {
        name: 'mode',
        choices: ['swing', 'folds', 'zigzag'],
        right: 'zigzag',
        start: fromAbove(slowly(0.05, hangingCloth(1e-3))),
        acts: [({run}) => fromAbove(slowly(0.05, hangingCloth(1.05 * run.limit)))],
        done: ({run, columns}) => run.failed && run.step > run.limit && columns > 0,
        arrows: growingMode,
        values: r => ({
          percent: Math.round(100 * opposedPart(growingMode(r).mode, r.columns, r.rows)),
          period: msText(2 * Math.PI / r.omega)
        })
      },
      {
        name: 'softer',
        choices: ['half', 'same', 'twice', 'four'],
        right: 'twice',
        start: hangingCloth(1e-3),
        then: (_, {before}) => hangingCloth(1e-3, allSprings(before.k / 4)),
        acts: [(_, {before}) => hangingCloth(1.9 * before.limit, allSprings(before.k / 4))],
        shown: before => ({k: before.k / 4}),
        done: ({run, at}, {before}) =>
            at('grid.stiffness.structural') < before.k && run.step >= 1.795 * before.limit && holds(run, 0.5)
      },
      {
        name: 'heavier',
        guess: {unit: 'ms', within: 0.1, read: ({run}) => 1000 * run.limit},
        start: hangingCloth(1e-3),
        then: (_, {before}) => heavyCloth(1e-3, before),
        acts: [
          ({run}, {before}) => heavyCloth(1.04 * run.limit, before),
          ({run}, {before}) => heavyCloth(0.96 * run.limit, before)
        ],
        enough: ({run}) => run.t >= 0.5,
        shown: before => ({mass: 4 * before.mass}),
        watch: ({run, at}, {before, all}) => {
          if (at('grid.mass') !== 4 * before.mass) return;
          if (run.failed) nearest(all, 'burst', run.step);
          if (holds(run, 0.5)) farthest(all, 'held', run.step);
        },
        done: (_, {all}) => all.burst > all.held && all.burst <= 1.115 * all.held,
        values: (_, {all}) => ({burst: msText(all.burst), held: msText(all.held)})
      },
      {
        name: 'finer',
        choices: ['twice', 'same', 'half'],
        right: 'half',
        start: hangingCloth(1e-3),
        then: () => ({...hangingCloth(1e-3), edit: finerCloth}),
        acts: [({run}) => ({...hangingCloth(0.95 * run.limit), edit: finerCloth})],
        enough: ({run}) => run.t >= 0.5,
        done: (r, {before}) => r.particles > 2 * before.particles && holds(r.run, 0.5),
        values: ({run}, {before}) => ({ratio: digits(run.limit / before.limit)})
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
        start: circle({}, ['explicit-euler', 0.1]),
        done: ({run}) => finished(run, 'explicit-euler'),
        values: ({run, at}) => {
          const a = run.step * at('rotation.rate');
          return {predicted: digits((1 + a * a) ** (run.steps / 2), 4), radius: `${digits(radiusOf(run.x), 4)} m`};
        }
      },
      {
        name: 'half',
        choices: ['same', 'half', 'none'],
        right: 'half',
        start: circle({}, ['explicit-euler', 0.05], ['explicit-euler', 0.1]),
        done: ({runs: [fine, coarse]}) =>
            finished(fine, 'explicit-euler') && finished(coarse, 'explicit-euler') && fine.step < 0.6 * coarse.step,
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
        start: circle({}, ['explicit-euler', 0.1], ['trapezoidal', 0.1]),
        done: ({runs: [euler, mean]}) => finished(euler, 'explicit-euler') && finished(mean, 'trapezoidal'),
        values: ({runs: [euler, mean], at}) => ({
          radius: digits(radiusOf(mean.x), 6),
          predicted: digits((1 + (mean.step * at('rotation.rate')) ** 4 / 4) ** (mean.steps / 2), 6),
          euler: digits(radiusOf(euler.x), 4)
        })
      },
      {
        name: 'faster',
        choices: ['same', 'half', 'quarter'],
        right: 'quarter',
        start: circle(fastCircle, ['explicit-euler', 0.1]),
        acts: [circle(fastCircle, ['explicit-euler', 0.025])],
        done: ({run, at}) => at('rotation.rate') === 4 && finished(run, 'explicit-euler') && radiusOf(run.x) < 1.9,
        values: ({run, at}) => {
          const omega = at('rotation.rate');
          return {omega, product: digits(run.step * omega), radius: digits(radiusOf(run.x), 4)};
        }
      },
      {
        name: 'largest',
        choices: ['never', 'some', 'always'],
        right: 'some',
        start: circle(longCircle, ['rk4', 0.6]),
        acts: [circle(longCircle, ['rk4', 0.73])],
        done: ({run, at}) => run.method === 'rk4' && rk4Factor(run.step * at('rotation.rate')) > 1 &&
            (run.failed || radiusOf(run.x) > 1.5),
        values: ({run, at}) => {
          const omega = at('rotation.rate');
          return {omega, limit: msText(2 * Math.SQRT2 / omega), factor: digits(rk4Factor(run.step * omega))};
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
        start: pendulum('explicit-euler', 5e-3),
        watch: ({run}, seen) => farthest(seen.run, 'gain', run.gain),
        done: ({run}, seen) => run.method === 'explicit-euler' && (run.failed || run.ended) && seen.run.gain > 0,
        values: ({run, omega}, seen) => {
          const a = run.step * omega;
          return {percent: digits(100 * (Math.sqrt(1 + a * a) - 1), 2), energy: digits(seen.run.gain)};
        }
      },
      {
        name: 'implicit',
        choices: ['gains', 'keeps', 'loses'],
        right: 'loses',
        start: pendulum('implicit-euler', 0.01),
        watch: ({run: {energy}}, seen) => {
          farthest(seen.run, 'top', energy?.gravitational ?? NaN);
          nearest(seen.run, 'bottom', energy?.gravitational ?? NaN);
        },
        done: ({run}) => finished(run, 'implicit-euler'),
        values: ({run}, seen) => ({energy: digits(-run.gain), swing: digits(seen.run.top - seen.run.bottom, 2)})
      },
      {
        name: 'leapfrog',
        choices: ['grows', 'falls', 'swings'],
        right: 'swings',
        start: pendulum('leapfrog', 0.01),
        watch: ({run}, seen) => {
          farthest(seen.run, 'high', run.gain);
          nearest(seen.run, 'low', run.gain);
        },
        done: ({run}) => finished(run, 'leapfrog'),
        values: ({run}, seen) =>
            ({low: digits(seen.run.low, 2), high: digits(seen.run.high, 2), end: digits(run.gain, 2)})
      },
      {
        name: 'which',
        choices: ['swing', 'spring', 'gravity'],
        right: 'spring',
        start: state('pendulum', {}, ['leapfrog', 0.06]),
        acts: [({run}) => state('pendulum', {}, ['leapfrog', 1.1 * run.limit])],
        shown: before => ({period: msText(2 * Math.PI / before.omega)}),
        done: ({run}) => run.method === 'leapfrog' && run.failed && run.step > run.limit,
        values: ({at}) => ({k: at('spring.stiffness'), m: at('particle.mass')})
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
        done: ({runs: [sticky, free]}) => finished(sticky, 'leapfrog+sticky') && finished(free, 'leapfrog'),
        values: r => ({moved: digits(movedBy(r, r.run)), away: digits(movedBy(r, r.runs[1]))})
      },
      {
        name: 'leaves',
        choices: ['early', 'middle', 'late'],
        right: 'middle',
        start: state('slide', {'time.samples': 100}, ['leapfrog', 1e-3]),
        done: ({run, at}, {before}) => at('sphere.friction') === before.friction && run.method === 'leapfrog' &&
            !run.failed && radiusOf(run.x) > 1.005 * (at('sphere.radius') + at('sphere.margin')),
        values: r => {
          const {angle, v, away} = lastContact(r), g = r.at('gravity.acceleration');
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
        shown: before => ({angle: degrees(before.angle * 180 / Math.PI)}),
        watch: (r, {before, all}) => {
          const mu = r.at('sphere.friction'), moved = movedBy(r, r.run);
          if (r.run.failed || Math.abs(startAngle(r) - before.angle) > 1e-9) return;
          if (moved > 0.02) farthest(all, 'slid', mu);
          if (r.run.ended && moved < 0.002) nearest(all, 'held', mu);
        },
        done: (_, {all}) => all.held > all.slid && all.held - all.slid < 0.1001,
        values: (r, {all: {held, slid}}) => ({tangent: digits(Math.tan(startAngle(r))), held, slid})
      },
      {
        name: 'cloth',
        choices: ['stays', 'slides', 'tears'],
        right: 'slides',
        start: slidingCloth(0.5),
        then: slidingCloth(0.1),
        shown: () => ({small: 0.1}),
        done: ({scene, run, at}) => scene === 'cloth-sphere' && at('sphere.friction') <= 0.1 && finished(run),
        values: ({run, at}, {before: {centre}}) => {
          const now = centreOf(run.x), angle = Math.asin(centre[0] / (at('sphere.radius') + at('sphere.margin')));
          return {
            sideways: digits(now[0] - centre[0]),
            down: digits(centre[1] - now[1]),
            angle: degrees(angle * 180 / Math.PI),
            tangent: digits(Math.tan(angle), 2)
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
        done: ({run, at}) => at('grid.stiffness.bend') === 0 && finished(run),
        values: foldValues
      },
      {
        name: 'with',
        choices: ['same', 'half', 'flat'],
        right: 'flat',
        start: hangingCloth(5e-4),
        watch: watchFold,
        done: ({run, at}, {before}) => at('grid.stiffness.bend') === before.bend && finished(run),
        values: foldValues
      },
      {
        name: 'price',
        choices: ['same', 'half', 'tenth'],
        right: 'half',
        start: hangingCloth(1e-3),
        then: (_, {before}) => hangingCloth(1e-3, {'grid.stiffness.bend': 10 * before.bend}),
        shown: before => ({bend: 10 * before.bend}),
        done: ({run, at}, {before}) => at('grid.stiffness.bend') >= 10 * before.bend && run.failed
      },
      {
        name: 'enough',
        choices: ['half', 'fifth', 'tenth'],
        right: 'tenth',
        start: hangingCloth(5e-4, {'grid.stiffness.bend': 0}),
        acts: [(_, {before}) => hangingCloth(5e-4, {'grid.stiffness.bend': before.k / 10})],
        shown: before => ({most: before.k / 10}),
        watch: watchFold,
        done: ({run, at}, seen) => {
          const bend = at('grid.stiffness.bend');
          return bend > 0 && bend <= seen.before.k / 10 && finished(run) && seen.run.fold < 30;
        },
        values: foldValues
      }
    ]
  }
];

/** Numbers for every question and task. */
export const shownNumbers = (step: GuideStep, before: Before): Values => ({
  particles: before.particles,
  omegaBefore: digits(before.omega, 4),
  limitBefore: msText(before.limit),
  kBefore: before.k,
  bendBefore: before.bend,
  massBefore: before.mass,
  muBefore: before.friction,
  ...step.shown?.(before)
});

/** Numbers for every explanation. */
export const foundNumbers = (step: GuideStep, r: Reading, seen: Seen): Values => ({
  h: msText(r.run.step),
  n: r.run.steps,
  t: `${Number(r.run.t.toPrecision(3))} s`,
  omega: digits(r.omega, 4),
  limit: msText(r.run.limit),
  bend: r.at('grid.stiffness.bend'),
  ...shownNumbers(step, seen.before),
  ...step.values?.(r, seen)
});
