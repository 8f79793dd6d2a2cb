#!/usr/bin/env node
// Jolt's soft body as an engine of crosscheck (PROTOCOL.md). `crosscheck engine jolt -o PROG` writes this file and the
// `wasm-compat` build of npm's jolt-physics behind it into one program, which may be moved; it needs Node alone.
//
// Jolt's rule, from its source and measured (README.md): `Update(h)` takes n sub-steps of d = h / n. Each adds
// gravity to the velocities, multiplies them by 1 - damping d, moves by v d, goes once through the edges, one after the
// other, correcting each by (L - r) / (w_a + w_b + compliance / d^2), and takes (x - x_before) / d for the velocity:
// extended position-based dynamics with one pass, compliance in m/N, independent of d. All in single precision.
//
// Options: n=N, Jolt's iterations, which are sub-steps (default 1; Jolt's own default is 5); frame=world puts the
// body's frame into the origin (default: into the middle of the scene's box, where coordinates are smallest).
'use strict';

const jolt_version = '1.1.0';
const known_terms = ['springs', 'constraints', 'gravity', 'drag', 'wind', 'sphere'];
const lacking = {
  bending: 'bending: Jolt bends by angles between triangles, not by a rigidity in N m',
  dashpots: 'dashpots: Jolt damps velocities only, not along springs',
  aerodynamics: 'aerodynamics: Jolt has no forces of the air on triangles',
  rotation: 'first-order fields',
};

function refuse(why) {
  console.error(why);
  process.exit(3);
}

/// What is asked, in the adapter's own terms; ends the program where Jolt cannot do it.
function ask(task) {
  if (task.first_order) refuse('Jolt has no first-order systems');
  const terms = Object.fromEntries(task.terms.map((term) => [term.type, term]));
  for (const type of Object.keys(terms))
    if (!known_terms.includes(type)) refuse(`not in Jolt: ${lacking[type] ?? type}`);
  const { mass, pinned, count } = task.particles;
  const asked = { task, count, iterations: 1, frame: 'scene', ...task.run };
  for (const option of task.options) {
    const [, key, value] = /^(n|frame)=(.+)$/.exec(option) ?? refuse(`unknown option ${option}: expected n= or frame=`);
    if (key === 'frame') asked.frame = value;
    if (key === 'n') asked.iterations = Number(value);
  }
  if (!['scene', 'world'].includes(asked.frame)) refuse(`frame=${asked.frame}: expected scene or world`);
  if (!Number.isInteger(asked.iterations) || asked.iterations < 1 || asked.iterations > 1e6)
    refuse('n= is a whole number from 1 to 1000000');

  const law = terms.springs?.law ?? 'hooke';
  if (law !== 'hooke') refuse(`springs of the law ${law}: Jolt has Hooke's`);
  asked.springs = terms.springs?.list ?? [];
  asked.rods = terms.constraints?.list ?? [];
  asked.gravity = terms.gravity?.acceleration ?? [0, 0, 0];
  asked.wind = terms.wind;
  asked.balls = terms.sphere?.list ?? [];
  if (asked.balls.some((ball) => ball.motion))
    refuse('moving spheres: in contact Jolt takes the velocity of a sphere that is led for zero');
  const gammas = (terms.drag?.coefficient ?? []).map((c, i) => c / mass[i]).filter((_, i) => !pinned[i]);
  asked.gamma = gammas[0] ?? 0;
  if (gammas.some((gamma) => Math.abs(gamma - asked.gamma) > 1e-6 * Math.abs(asked.gamma)))
    refuse('drag that differs between particles: Jolt has one damping (1/s) for a body');
  if (asked.gamma * asked.step >= asked.iterations) refuse('drag that takes all speed in one sub-step');
  return asked;
}

/// Acceleration of gravity and wind at t, m/s^2: to free particles both are one, and Jolt is told so.
function acceleration_at({ gravity, wind }, t) {
  if (!wind) return gravity;
  const gusts = wind.gusts, waves = (list) => list.reduce((s, w) => s + w.weight * Math.sin(w.omega * t + w.phase), 0);
  const along = gusts ? 1 + gusts.variation * waves(gusts.along) : 1, across = gusts ? waves(gusts.across) : 0;
  return gravity.map((g, k) => g + wind.acceleration[k] * along + (gusts ? gusts.side[k] * across : 0));
}

/// Where the pins are at t, m.
function pins_at({ task }, t) {
  const { home = [], motion } = task.pins ?? {};
  if (!motion) return home;
  const s = Math.min(t / motion.ramp, 1), r = s ** 3 * (10 + s * (6 * s - 15));
  const led = r * Math.sin(2 * Math.PI * motion.frequency * t);
  return home.map((x) => x.map((e, k) => e + motion.amplitude[k] * led));
}

class World {
  constructor(Jolt) {
    this.Jolt = Jolt;
    const settings = new Jolt.JoltSettings(), pairs = new Jolt.ObjectLayerPairFilterTable(1);
    pairs.EnableCollision(0, 0);
    const layers = new Jolt.BroadPhaseLayerInterfaceTable(1, 1);
    layers.MapObjectToBroadPhaseLayer(0, new Jolt.BroadPhaseLayer(0));
    settings.mObjectLayerPairFilter = pairs;
    settings.mBroadPhaseLayerInterface = layers;
    settings.mObjectVsBroadPhaseLayerFilter = new Jolt.ObjectVsBroadPhaseLayerFilterTable(layers, 1, pairs, 1);
    this.jolt = new Jolt.JoltInterface(settings);
    this.system = this.jolt.GetPhysicsSystem();
    this.bodies = this.system.GetBodyInterface();
    this.scratch = new Jolt.Vec3();
  }
  vec3(v) { return this.scratch.Set(...v), this.scratch; }
  set_gravity(g) { this.system.SetGravity(this.vec3(g)); }
  gravity() { return components(this.system.GetGravity()); }

  /// A soft body with its frame at `origin`; vertices: x (in the frame, m), v (m/s), inverse_mass (1/kg); edges: a, b,
  /// rest (m), compliance (m/N).
  add_soft_body({ origin, vertices, edges, iterations, damping }) {
    const { Jolt } = this, shared = new Jolt.SoftBodySharedSettings(), vertex = new Jolt.SoftBodySharedSettingsVertex();
    for (const { x, v, inverse_mass } of vertices) {
      vertex.mPosition = new Jolt.Float3(...x);
      vertex.mVelocity = new Jolt.Float3(...v);
      vertex.mInvMass = inverse_mass;
      shared.mVertices.push_back(vertex);
    }
    for (const { a, b, rest, compliance } of edges) {
      const edge = new Jolt.SoftBodySharedSettingsEdge(a, b, compliance);
      edge.mRestLength = rest;
      shared.mEdgeConstraints.push_back(edge);
    }
    shared.Optimize();  // without it the first step reads out of bounds
    const position = new Jolt.RVec3(...origin), upright = Jolt.Quat.prototype.sIdentity();
    const creation = new Jolt.SoftBodyCreationSettings(shared, position, upright, 0);
    creation.mNumIterations = iterations;
    creation.mLinearDamping = damping;   // default 0.1 / s
    creation.mMaxLinearVelocity = 1e15;  // m/s, default 500: faster vertices are slowed in silence
    creation.mUpdatePosition = false;    // else the frame follows, and vertices are rounded once more in each step
    creation.mAllowSleeping = false;     // else what is slower than 0.17 m/s for half a second stops
    creation.mFriction = 1;              // of a contact: sqrt(body's times sphere's)
    creation.mRestitution = 0;           // of a contact: the larger of the two
    const body = this.bodies.CreateSoftBody(creation);
    this.bodies.AddBody(body.GetID(), Jolt.EActivation_Activate);
    return new SoftBody(this, body);
  }

  /// Particles touch a ball at radius + margin: the radius of Jolt's sphere, whose vertices have none.
  add_ball({ centre, radius, margin, friction, restitution }) {
    const { Jolt } = this, position = new Jolt.RVec3(...centre), shape = new Jolt.SphereShape(radius + margin);
    const upright = Jolt.Quat.prototype.sIdentity();
    const creation = new Jolt.BodyCreationSettings(shape, position, upright, Jolt.EMotionType_Static, 0);
    creation.mFriction = friction ** 2;
    creation.mRestitution = restitution;
    const body = this.bodies.CreateBody(creation);
    this.bodies.AddBody(body.GetID(), Jolt.EActivation_DontActivate);
    return body;
  }
}

const components = (v) => [v.GetX(), v.GetY(), v.GetZ()];

class SoftBody {
  constructor(world, body) {
    this.world = world;
    this.body = body;
    this.motion = world.Jolt.castObject(body.GetMotionProperties(), world.Jolt.SoftBodyMotionProperties);
    this.vertices = Array.from({ length: this.motion.GetVertices().size() }, (_, i) => this.motion.GetVertex(i));
  }
  origin() { return components(this.body.GetCenterOfMassPosition()); }
  /// In the scene's coordinates; the sum is made in double precision.
  positions() {
    const origin = this.origin();
    return this.vertices.map((vertex) => components(vertex.mPosition).map((e, k) => origin[k] + e));
  }
  velocities() { return this.vertices.map((vertex) => components(vertex.mVelocity)); }
  set_position(i, x) {
    const origin = this.origin();
    this.vertices[i].mPosition = this.world.vec3(x.map((e, k) => e - origin[k]));
  }
  set_velocity(i, v) { this.vertices[i].mVelocity = this.world.vec3(v); }
  /// In the order they were given in, which Jolt changes: parallel edges keep theirs.
  edges_like(wanted) {
    const edges = this.motion.GetSettings().mEdgeConstraints, found = new Map();
    for (let i = 0; i < edges.size(); ++i) {
      const edge = edges.at(i), ends = `${edge.get_mVertex(0)} ${edge.get_mVertex(1)}`;
      if (!found.has(ends)) found.set(ends, []);
      found.get(ends).push({ rest: edge.mRestLength, compliance: edge.mCompliance });
    }
    return wanted.map(({ a, b }) => ({ a, b, ...found.get(`${a} ${b}`).shift() }));
  }
}

/// Springs, then rods, as edges.
function edges_of({ springs, rods }) {
  return [...springs.map(({ a, b, stiffness: k, rest_length: rest }) => ({ a, b, rest, compliance: 1 / k })),
          ...rods.map(({ a, b, length: rest }) => ({ a, b, rest, compliance: 0 }))];
}

function body_of(world, asked) {
  const { x, v, mass, pinned } = asked.task.particles, { iterations, gamma: damping } = asked;
  const extreme = (pick, k) => x.reduce((found, p) => pick(found, p[k]), x[0][k]);
  const middle = [0, 1, 2].map((k) => Math.fround((extreme(Math.min, k) + extreme(Math.max, k)) / 2));
  const origin = asked.frame === 'world' ? [0, 0, 0] : middle;
  const vertices = x.map((p, i) => ({
    x: p.map((e, k) => e - origin[k]), v: v[i], inverse_mass: pinned[i] ? 0 : 1 / mass[i] }));
  return world.add_soft_body({ origin, vertices, edges: edges_of(asked), iterations, damping });
}

/// The forces of the springs at x, as Jolt computes them, N: each spring alone, from a free vertex in the origin, where
/// small moves are not rounded away, to a held one, in one step d. The vertex has w d^2 = 1e-6 compliance, so that it
/// moves by w d^2 k (L - r) to a millionth.
function spring_forces(world, { springs, count }, x) {
  const forces = Array.from({ length: count }, () => [0, 0, 0]), d = 2 ** -10, at_once = 500;
  world.set_gravity([0, 0, 0]);
  for (let first = 0; first < springs.length; first += at_once) {
    const some = springs.slice(first, first + at_once);
    const vertices = some.flatMap(({ a, b, stiffness }) => [
      { x: [0, 0, 0], v: [0, 0, 0], inverse_mass: 1e-6 / (stiffness * d * d) },
      { x: x[b].map((e, k) => e - x[a][k]), v: [0, 0, 0], inverse_mass: 0 }]);
    const edges = edges_of({ springs: some, rods: [] }).map((edge, i) => ({ ...edge, a: 2 * i, b: 2 * i + 1 }));
    const probe = world.add_soft_body({ origin: [0, 0, 0], vertices, edges, iterations: 1, damping: 0 });
    world.jolt.Step(d, 1);
    some.forEach(({ a, b }, i) => {
      const { mPosition: moved, mInvMass: w } = probe.vertices[2 * i];
      components(moved).forEach((e, k) => {
        forces[a][k] += e / (w * d * d);
        forces[b][k] -= e / (w * d * d);
      });
    });
    world.bodies.RemoveBody(probe.body.GetID());
    world.bodies.DestroyBody(probe.body.GetID());
  }
  return forces;
}

/// All steps; frames at the samples, and the CPU time of stepping (s).
function run(world, body, asked) {
  const { step: h, steps_per_sample, samples, task } = asked, { particles: pins = [], motion: led } = task.pins ?? {};
  const frames = [body.positions()], speeds = [body.velocities()], steps = samples * steps_per_sample;
  let cpu = 0;
  for (let sample = 1; sample <= samples; ++sample) {
    const begin = process.cpuUsage();
    for (let i = (sample - 1) * steps_per_sample; i < sample * steps_per_sample; ++i) {
      if (asked.wind) world.set_gravity(acceleration_at(asked, i * h));
      if (!led) {
        world.jolt.Step(h, 1);
        continue;
      }
      // a held vertex moves by its velocity; its place is set too, since n sub-steps round n times
      const from = pins_at(asked, i * h), to = pins_at(asked, (i + 1) * h);
      pins.forEach((pin, p) => body.set_velocity(pin, to[p].map((e, k) => (e - from[p][k]) / h)));
      world.jolt.Step(h, 1);
      pins.forEach((pin, p) => body.set_position(pin, to[p]));
    }
    const used = process.cpuUsage(begin);
    cpu += (used.user + used.system) / 1e6;
    frames.push(body.positions());
    speeds.push(body.velocities());
  }
  return { frames, speeds, steps, cpu };
}

/// A step begins above the ball, on the plane that was tangent where the step before began: that takes half of v^2 / R
/// more off the depth, from which friction is computed (README.md).
function different_law({ balls }) {
  return balls.some((ball) => ball.friction > 0)
    ? ['friction: on a ball of radius R it is mu m (g_n - 3/2 v^2 / R) with one iteration, not mu m (g_n - v^2 / R)']
    : [];
}

/// What Jolt holds, read from its own objects before the first step.
function read_back(world, body, balls, asked) {
  const { motion } = body, rate = motion.GetLinearDamping(), inverse = body.vertices.map((vertex) => vertex.mInvMass);
  return {
    precision: 'single',
    mass: inverse.map((w) => (w > 0 ? 1 / w : 0)),
    pinned: inverse.map((w) => (w > 0 ? 0 : 1)),
    links: body.edges_like(edges_of(asked)).map(({ a, b, rest, compliance }) => ({
      a, b, rest_length: rest, ...(compliance > 0 ? { stiffness: 1 / compliance } : {}) })),
    gravity: world.gravity().map((g) => g * motion.GetGravityFactor()),
    drag: inverse.map(() => rate),
    spheres: balls.map((ball) => ({
      centre: components(ball.GetPosition()),
      radius: world.Jolt.castObject(ball.GetShape(), world.Jolt.SphereShape).GetRadius() + motion.GetVertexRadius(),
      friction: Math.sqrt(ball.GetFriction() * body.body.GetFriction()),
      restitution: Math.max(ball.GetRestitution(), body.body.GetRestitution()) })),
    may_sleep: motion.GetAllowSleeping(),
    step: Math.fround(asked.step),
    start: { x: body.positions(), v: body.velocities() },
    mapped: { stiffness: 'compliance of an edge, 1 / k (m/N)', drag: 'linear damping (1/s)',
              ...(asked.wind ? { wind: 'gravity, set anew before each step' } : {}),
              ...(balls.length ? { spheres: 'static spheres of radius + margin, vertices without radius' } : {}) },
    settings: { 'jolt-physics': jolt_version, iterations: String(motion.GetNumIterations()), frame: asked.frame,
                'largest speed': `${motion.GetMaxLinearVelocity()} m/s`, pressure: String(motion.GetPressure()) },
  };
}

function npy(frames) {
  const shape = `(${frames.length}, ${frames[0].length}, 3)`;
  const words = `{'descr': '<f8', 'fortran_order': False, 'shape': ${shape}, }`.padEnd(117) + '\n';
  const magic = Buffer.from('\x93NUMPY\x01\x00\x76\x00', 'latin1');
  return Buffer.concat([magic, Buffer.from(words), Buffer.from(new Float64Array(frames.flat(2)).buffer)]);
}

async function main([scene, out]) {
  const { readFileSync, writeFileSync } = await import('node:fs');
  const asked = ask(JSON.parse(readFileSync(scene, 'utf8'))), { task } = asked;
  const world = new World(await Jolt());
  world.set_gravity(asked.gravity);
  const body = body_of(world, asked), balls = asked.balls.map((ball) => world.add_ball(ball));
  const readback = read_back(world, body, balls, asked);
  const { frames, speeds, steps, cpu } = run(world, body, asked);
  const last = frames.at(-1), pins = task.pins?.particles ?? [];
  readback.later = { t: task.run.times.at(-1), pins: pins.map((pin) => last[pin]),
                     centres: balls.map((ball) => components(ball.GetPosition())) };

  world.set_gravity(acceleration_at(asked, 0.3));
  const extra = world.gravity().map((g, k) => g - readback.gravity[k]);
  const none = last.map(() => [0, 0, 0]), x = task.particles.x.map((p) => p.map((e) => 1.1 * e));
  [body.body, ...balls].forEach((one) => world.bodies.RemoveBody(one.GetID()));
  readback.probe = { t: 0.3, x, v: none, springs: spring_forces(world, asked, x), dashpots: none,
                     wind: readback.mass.map((m) => extra.map((e) => m * e)) };

  writeFileSync(`${out}/trajectory.npy`, npy(frames));
  writeFileSync(`${out}/velocities.npy`, npy(speeds));
  const force_evaluations = steps * asked.iterations * 2;
  writeFileSync(`${out}/run.json`, JSON.stringify({
    cpu_seconds: cpu, steps, force_evaluations, different_law: different_law(asked), readback }));
}

main(process.argv.slice(2)).catch((error) => {
  console.error(error.message ?? error);
  process.exit(1);
});
