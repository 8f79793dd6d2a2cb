// Shared part of crosscheck's engines in JavaScript (see PROTOCOL.md): reads the scene, evaluates its forces and
// motions, runs the time loop and writes the three files. Node 18 or newer, no packages. An engine is a single call:
//
//   serve({ engine: 'Name 1.0', terms: ['springs', 'gravity'] }, (scene) => ({
//     step(t, next) { … },     // advances the world from time t to time next (s); only this is timed
//     read(x, v, t) { … },     // copies positions (m) and velocities (m/s) at time t into two flat arrays
//     report() { … },          // entries of run.json, after the last step; `readback` needs no start, step or t
//   }));
//
// Vectors of all particles are flat Float64Arrays (x0, y0, z0, x1, ...); other vectors are arrays of three numbers.
import { readFileSync, writeFileSync } from 'node:fs';
import { createInterface } from 'node:readline';

class Unsupported extends Error {}
class Failed extends Error {}

/// Refuses an unsupported scene (exit status 3).
export function unsupported(reason) {
  throw new Unsupported(reason);
}

/// Ends the run with a verdict of run.json (`nan`, `solver`, ...); the frames so far are kept.
export function failed(verdict, reason) {
  throw Object.assign(new Failed(reason), { verdict });
}

/// Displacement (m), velocity (m/s) and acceleration (m/s^2) of pins or a sphere at time t; zero without a motion.
export function motionAt(motion, t) {
  if (!motion) return { displacement: [0, 0, 0], velocity: [0, 0, 0], acceleration: [0, 0, 0] };
  const { amplitude, frequency, ramp } = motion, omega = 2 * Math.PI * frequency, s = Math.min(t / ramp, 1);
  const sine = Math.sin(omega * t), cosine = Math.cos(omega * t), r = s ** 3 * (10 + s * (6 * s - 15));
  const slope = (30 * s * s * (1 - s) ** 2) / ramp, bend = (60 * s * (1 - s) * (1 - 2 * s)) / ramp ** 2;
  const speed = slope * sine + r * omega * cosine;
  const rise = bend * sine + 2 * slope * omega * cosine - r * omega * omega * sine;
  return { displacement: amplitude.map((a) => a * (r * sine)), velocity: amplitude.map((a) => a * speed),
           acceleration: amplitude.map((a) => a * rise) };
}

/// Acceleration by the wind, or velocity of the air, at time t, with gusts; in the unit of `mean`.
function blowing(mean, gusts, t) {
  if (!gusts) return [...mean];
  const waves = (list) => list.reduce((sum, w) => sum + w.weight * Math.sin(w.omega * t + w.phase), 0);
  const along = 1 + gusts.variation * waves(gusts.along), across = waves(gusts.across);
  return mean.map((e, k) => e * along + gusts.side[k] * across);
}

/// A term's links as arrays: ends a and b, and one array per named number.
function links(list, numbers) {
  const columns = { list, count: list.length };
  columns.a = Int32Array.from(list, (link) => link.a);
  columns.b = Int32Array.from(list, (link) => link.b);
  for (const [name, key] of Object.entries(numbers)) columns[name] = Float64Array.from(list, (link) => link[key]);
  return columns;
}

export class Scene {
  /// `task`: the content of scene.json.
  constructor(task) {
    const { particles, run, pins } = task;
    this.task = task;
    this.name = task.name;
    this.firstOrder = task.first_order;
    this.terms = new Map(task.terms.map((term) => [term.type, term]));
    this.count = particles.count;
    this.x = Float64Array.from(particles.x.flat());                          // m, at t = 0
    this.v = particles.v ? Float64Array.from(particles.v.flat()) : new Float64Array(3 * this.count);  // m/s
    this.mass = Float64Array.from(particles.mass ?? []);                     // kg
    this.pinned = Uint8Array.from(particles.pinned ?? new Uint8Array(this.count));
    this.h = run.step;                                                       // s
    this.stepsPerSample = run.steps_per_sample;
    this.samples = run.samples;
    this.times = run.times;                                                  // s, of the samples
    this.pins = { particles: pins?.particles ?? [], home: pins?.home ?? [], motion: pins?.motion };

    const term = (type) => this.terms.get(type) ?? {};
    const numbers = { k: 'stiffness', rest: 'rest_length' };                 // N/m, m
    this.springs = { law: term('springs').law ?? 'hooke', ...links(term('springs').list ?? [], numbers) };
    this.dashpots = links(term('dashpots').list ?? [], { c: 'coefficient' });  // N s/m
    this.rods = links(term('constraints').list ?? [], { length: 'length' });   // m
    this.bending = term('bending').list ?? [];
    this.gravity = term('gravity').acceleration ?? [0, 0, 0];                // m/s^2
    this.drag = Float64Array.from(term('drag').coefficient ?? new Float64Array(this.count));  // N s/m
    this.damping = this.drag.map((c, i) => c / this.mass[i]);                // 1/s
    this.wind = this.terms.get('wind');
    this.air = this.terms.get('aerodynamics');
    this.spheres = term('sphere').list ?? [];
    this.planes = term('plane').list ?? [];
    this.triangles = task.triangles ?? [];
    this.words = new Map(task.options.map((text) => [text.split('=', 1)[0], text]));
    this.expected = [];
  }

  /// Value of option NAME=VALUE. `otherwise`: the default number (the option must be positive, and whole if the default
  /// is), or a list of all allowed words, the default first.
  option(name, otherwise) {
    const text = this.words.get(name), value = text?.slice(name.length + 1), words = Array.isArray(otherwise);
    this.words.delete(name);
    this.expected.push(words ? `${name}=${otherwise.join('|')}` : `${name}=NUMBER (default ${otherwise})`);
    if (text === undefined) return words ? otherwise[0] : otherwise;
    if (words) return otherwise.includes(value) ? value : unsupported(`${text}: expected ${otherwise.join(' or ')}`);
    const number = Number(value), whole = Number.isInteger(otherwise);
    if (!value || !(number > 0 && number <= 1e6) || (whole && !Number.isInteger(number)))
      unsupported(`${text}: expected a ${whole ? 'whole ' : ''}number above 0, at most 1000000`);
    return number;
  }
  /// Refuses the options for which option() has not been called.
  requireKnownOptions() {
    for (const text of this.words.values())
      unsupported(`unknown option ${text}: expected ${this.expected.join(' or ') || 'no option'}`);
  }

  /// Acceleration by the wind (m/s^2) and velocity of the air (m/s) at time t.
  windAt(t) { return this.wind ? blowing(this.wind.acceleration, this.wind.gusts, t) : [0, 0, 0]; }
  airAt(t) { return this.air ? blowing(this.air.velocity, this.air.gusts, t) : [0, 0, 0]; }
  /// Motion of all pins at time t, like motionAt().
  pinMotion(t) { return motionAt(this.pins.motion, t); }
  /// Particle, position x (m) and velocity v (m/s) of each pin at time t.
  pinsAt(t) {
    const { particles, home } = this.pins, { displacement, velocity } = this.pinMotion(t);
    return particles.map((particle, i) => ({ particle, x: home[i].map((e, k) => e + displacement[k]), v: velocity }));
  }
  placePins(t, x, v) {
    for (const pin of this.pinsAt(t)) x.set(pin.x, 3 * pin.particle), v.set(pin.v, 3 * pin.particle);
  }
  /// Distance of a link's ends at t = 0 (m).
  lengthOf({ a, b }) { return Math.hypot(...[0, 1, 2].map((k) => this.x[3 * a + k] - this.x[3 * b + k])); }
  /// The drag rate of all free particles (1/s); refuses rates that differ.
  oneDamping(reason) {
    const all = this.damping.filter((_, i) => !this.pinned[i]), first = all[0] ?? 0;
    return all.some((e) => Math.abs(e - first) > 1e-6 * first) ? unsupported(reason) : first;
  }

  /// Position (m) at time t of a sphere's centre, or of a plane's face shifted out of the solid by `off` (m).
  obstacleAt({ centre, motion, point, normal, velocity = [0, 0, 0] }, t, off = 0) {
    if (point) return point.map((p, k) => p + velocity[k] * t + off * normal[k]);
    const { displacement } = motionAt(motion, t);
    return centre.map((c, k) => c + displacement[k]);
  }

  // Forces (N), added to f.

  /// Returns the number of springs whose ends coincide and which therefore exert no force.
  addSpringForces(x, f) {
    const { a, b, k, rest, count, law } = this.springs, hooke = law === 'hooke';
    let coincident = 0;
    for (let i = 0; i < count; ++i) {
      const p = 3 * a[i], q = 3 * b[i], dx = x[p] - x[q], dy = x[p + 1] - x[q + 1], dz = x[p + 2] - x[q + 2];
      const squared = dx * dx + dy * dy + dz * dz, l = Math.sqrt(squared), r = rest[i];
      if (!(l > 0)) {
        ++coincident;
        continue;
      }
      const pull = hooke ? (k[i] * (l - r)) / l : (k[i] * (squared - r * r)) / (squared + r * r);
      f[p] -= pull * dx, f[p + 1] -= pull * dy, f[p + 2] -= pull * dz;
      f[q] += pull * dx, f[q + 1] += pull * dy, f[q + 2] += pull * dz;
    }
    return coincident;
  }
  addDashpotForces(x, v, f) {
    const { a, b, c, count } = this.dashpots;
    for (let i = 0; i < count; ++i) {
      const p = 3 * a[i], q = 3 * b[i], dx = x[p] - x[q], dy = x[p + 1] - x[q + 1], dz = x[p + 2] - x[q + 2];
      const squared = dx * dx + dy * dy + dz * dz;
      if (!(squared > 0)) continue;
      const growth = dx * (v[p] - v[q]) + dy * (v[p + 1] - v[q + 1]) + dz * (v[p + 2] - v[q + 2]);
      const pull = (c[i] * growth) / squared;
      f[p] -= pull * dx, f[p + 1] -= pull * dy, f[p + 2] -= pull * dz;
      f[q] += pull * dx, f[q + 1] += pull * dy, f[q + 2] += pull * dz;
    }
  }
  addBendingForces(x, f) {
    for (const { particles, weights, stiffness } of this.bending)
      for (let k = 0; k < 3; ++k) {
        let c = 0;
        for (let i = 0; i < particles.length; ++i) c += weights[i] * x[3 * particles[i] + k];
        for (let i = 0; i < particles.length; ++i) f[3 * particles[i] + k] -= stiffness * weights[i] * c;
      }
  }
  addWindForces(t, f) {
    if (!this.wind) return;
    const w = this.windAt(t);
    for (let i = 0; i < f.length; ++i) f[i] += this.mass[(i / 3) | 0] * w[i % 3];
  }

  /// Springs, then rods, with the values that `attest(index, link, is_rod)` reads back: rest_length (m), stiffness
  /// (N/m).
  linksRead(attest) {
    const all = [...this.springs.list, ...this.rods.list];
    return all.map((link, i) => ({ a: link.a, b: link.b, ...attest(i, link, i >= this.springs.count) }));
  }
  /// A state that shows the law of every spring: the initial positions, stretched about the origin by a tenth, or by
  /// more if a spring would be within a hundredth of its rest length. It grows, so that dashpots act too, and is curved
  /// if there is bending.
  probeState() {
    const l = this.springs.list.map((spring) => this.lengthOf(spring)), { rest } = this.springs;
    let tenths = 11;
    while (tenths < 30 && l.some((e, i) => e && Math.abs((tenths / 10) * e - rest[i]) <= 0.01 * rest[i])) ++tenths;
    const along = (i) => [0, 1, 2].reduce((sum, k) => sum + (k + 1) * this.x[i - (i % 3) + k], 0);  // x + 2 y + 3 z
    const x = this.x.map((e, i) => (tenths / 10) * e + (this.bending.length && 0.02 * along(i) ** 2 / this.task.size));
    return { t: 0.3, x, v: this.x.map((e) => 0.5 * e) };
  }
  /// Probe for an engine whose forces are the functions above.
  ownProbe() {
    const probe = this.probeState(), force = (add) => {
      const f = new Float64Array(3 * this.count);
      add(f);
      return f;
    };
    probe.springs = force((f) => this.addSpringForces(probe.x, f));
    probe.dashpots = force((f) => this.addDashpotForces(probe.x, probe.v, f));
    probe.bending = force((f) => this.addBendingForces(probe.x, f));
    probe.wind = force((f) => this.addWindForces(probe.t, f));
    return probe;
  }
}

/// Frames of one quantity in NumPy's format: a header of 128 bytes, then the numbers.
class Frames {
  constructor(frames, count) {
    this.size = 3 * count;
    this.count = count;
    this.bytes = new ArrayBuffer(128 + 8 * this.size * frames);
  }
  frame(i) { return new Float64Array(this.bytes, 128 + 8 * this.size * i, this.size); }
  write(file, frames) {
    const words = `{'descr': '<f8', 'fortran_order': False, 'shape': (${frames}, ${this.count}, 3), }`;
    Buffer.from(this.bytes).write('\x93NUMPY\x01\x00\x76\x00' + words.padEnd(117) + '\n', 'latin1');
    writeFileSync(file, Buffer.from(this.bytes, 0, 128 + 8 * this.size * frames));
  }
}

/// A flat array as a list of vectors.
const vectors = (flat) => Array.from({ length: flat.length / 3 }, (_, i) => [...flat.subarray(3 * i, 3 * i + 3)]);

/// Text of run.json: flat arrays of the particles' vectors become lists; non-finite numbers are left out.
function runText(run) {
  const probe = run.readback?.probe;
  if (probe) for (const key in probe) if (probe[key] instanceof Float64Array) probe[key] = vectors(probe[key]);
  return JSON.stringify(run, (_, value) => {
    if (ArrayBuffer.isView(value)) return [...value];
    return typeof value === 'number' && !Number.isFinite(value) ? undefined : value;
  });
}

/// Refuses unsupported terms, laws and first-order scenes.
function requireTerms(scene, { engine, terms, lacks = {}, laws = ['hooke'] }) {
  const name = engine.replace(/ [0-9.]+$/, '');
  if (scene.firstOrder && !terms.includes('rotation')) unsupported(`${name} has no first-order systems`);
  for (const type of scene.terms.keys())
    if (!terms.includes(type)) unsupported(`${name} has no ${type}${lacks[type] ? `: ${lacks[type]}` : ''}`);
  if (scene.springs.count && !laws.includes(scene.springs.law))
    unsupported(`${name} has no springs of the law ${scene.springs.law}`);
}

/// Runs one scene, as `PROGRAM scene.json OUTDIR`.
async function runScene(file, out, description, makeWorld) {
  const scene = new Scene(JSON.parse(readFileSync(file, 'utf8'))), { samples, stepsPerSample, h, count } = scene;
  requireTerms(scene, description);
  const world = await makeWorld(scene);
  try {
    scene.requireKnownOptions();
    const x = new Frames(samples + 1, count), v = new Frames(samples + 1, count), run = {};
    world.read(x.frame(0), v.frame(0), 0);
    let microseconds = 0, frames = 1, steps = 0;
    try {
      for (; frames <= samples; ++frames) {
        const begin = process.cpuUsage();
        for (let i = 0; i < stepsPerSample; ++i, ++steps) world.step(steps * h, (steps + 1) * h);
        const used = process.cpuUsage(begin);
        microseconds += used.user + used.system;
        world.read(x.frame(frames), v.frame(frames), steps * h);
      }
    } catch (error) {
      if (!(error instanceof Failed)) throw error;
      const end = Math.min(steps * h, scene.times.at(-1));
      Object.assign(run, { verdict: error.verdict, reason: error.message, end });
    }
    const last = x.frame(frames - 1), pin = (i) => [...last.subarray(3 * i, 3 * i + 3)];
    const told = { engine: description.engine, serves: true, cpu_seconds: microseconds / 1e6, steps,
                   force_evaluations: steps, ...run, ...world.report() };
    if (told.readback) {
      const later = { t: scene.times[frames - 1], pins: scene.pins.particles.map(pin), centres: [] };
      Object.assign(told.readback, { step: told.readback.step ?? h, later: { ...later, ...told.readback.later },
                                     start: { x: vectors(x.frame(0)), v: vectors(v.frame(0)) } });
    }
    x.write(`${out}/trajectory.npy`, frames);
    v.write(`${out}/velocities.npy`, frames);
    writeFileSync(`${out}/run.json`, runText(told));
  } finally {
    world.free?.();
  }
}

/// Exit status (0, 3: unsupported, or 1) and reason of a call. `broken`: WebAssembly trapped; memory may be damaged.
async function answer(call) {
  try {
    await call();
    return { status: 0 };
  } catch (error) {
    const reason = String(error?.message ?? error).trim().replace(/\s*\n\s*/g, '; ');  // one line
    return { status: error instanceof Unsupported ? 3 : 1, reason, broken: error instanceof WebAssembly.RuntimeError };
  }
}

/// The program's main function: runs one scene, or with --serve those named on stdin. `description`: `engine` (name,
/// version), `terms` (supported), optionally `lacks` (reasons for missing terms), `laws` (of springs), and `init`,
/// which runs once before the first world is made and may set `engine`. A world's `free` is called after its scene.
export async function serve(description, makeWorld) {
  let ready;
  const run = (scene, out) => answer(() => runScene(scene, out, description, async (asked) => {
    await (ready ??= description.init?.());
    return makeWorld(asked);
  }));
  const [first, out] = process.argv.slice(2);
  if (first !== '--serve') {
    const { status, reason } = await run(first, out);
    if (reason) console.error(reason);
    process.exitCode = status;
    return;
  }
  console.log = console.info = console.error;  // stdout is for answers only
  for await (const line of createInterface({ input: process.stdin })) {
    const { broken, ...told } = await answer(async () => JSON.parse(line)).then(async (read) => {
      if (read.status) return read;
      const task = JSON.parse(line);
      return run(task.scene, task.out);
    });
    process.stdout.write(JSON.stringify(told) + '\n');
    if (broken) process.exit(1);
  }
}
