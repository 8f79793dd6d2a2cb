#!/usr/bin/env node
// Jolt's soft body (npm's WebAssembly build) as an engine of crosscheck (PROTOCOL.md), in single precision.
//
// Jolt's rule (measured: README.md in this folder): `Update(h)` performs n sub-steps of d = h / n. Each adds gravity to
// the velocities, multiplies them by 1 - damping d, and moves by v d. It then corrects one edge after another, once, by
// (L - r) / (w_a + w_b + compliance / d^2), and sets the velocity to (x - x_before) / d. This is extended
// position-based dynamics with one pass; compliance is in m/N, independent of d.
//
// Options: n=N, Jolt's iterations, which are sub-steps (default 1; Jolt's own default is 5); frame=scene|world: the
// origin of the body's frame is the middle of the scene's box, where coordinates are smallest, or the world's origin.
import loadJolt from 'jolt-physics/wasm-compat';
import { serve, unsupported } from '../protocol/crosscheck_engine.mjs';

let Jolt;
const description = {
  engine: 'jolt-physics 1.1.0',
  terms: ['springs', 'constraints', 'gravity', 'drag', 'wind', 'sphere'],
  lacks: { bending: 'Jolt bends by angles between triangles, not by a rigidity in N m',
           dashpots: 'Jolt damps velocities only, not along springs' },
  init: async () => (Jolt = await loadJolt()),
};
const components = (v) => [v.GetX(), v.GetY(), v.GetZ()];

class World {
  constructor() {
    const settings = new Jolt.JoltSettings(), pairs = new Jolt.ObjectLayerPairFilterTable(1);
    pairs.EnableCollision(0, 0);
    const layers = new Jolt.BroadPhaseLayerInterfaceTable(1, 1);
    layers.MapObjectToBroadPhaseLayer(0, new Jolt.BroadPhaseLayer(0));
    const both = new Jolt.ObjectVsBroadPhaseLayerFilterTable(layers, 1, pairs, 1), tables = {
      mObjectLayerPairFilter: pairs, mBroadPhaseLayerInterface: layers, mObjectVsBroadPhaseLayerFilter: both };
    this.jolt = new Jolt.JoltInterface(Object.assign(settings, tables));  // owns the tables
    Jolt.destroy(settings);
    this.system = this.jolt.GetPhysicsSystem();
    this.bodies = this.system.GetBodyInterface();
    [this.scratch, this.upright] = [new Jolt.Vec3(), Jolt.Quat.prototype.sIdentity()];
  }
  vec3(v) { return this.scratch.Set(...v), this.scratch; }
  setGravity(g) { this.system.SetGravity(this.vec3(g)); }
  gravity() { return components(this.system.GetGravity()); }
  remove(body) { for (const act of ['RemoveBody', 'DestroyBody']) this.bodies[act](body.GetID()); }

  /// Adds a soft body with its frame at `origin`. Vertices: x (in the frame, m), v (m/s), w (1/kg). Edges: rest (m),
  /// compliance (m/N).
  addSoftBody({ origin, vertices, edges, iterations, damping }) {
    const shared = new Jolt.SoftBodySharedSettings(), vertex = new Jolt.SoftBodySharedSettingsVertex();
    for (const { x, v, w } of vertices) {
      const given = { mPosition: new Jolt.Float3(...x), mVelocity: new Jolt.Float3(...v), mInvMass: w };
      shared.mVertices.push_back(Object.assign(vertex, given));
      Jolt.destroy(given.mPosition), Jolt.destroy(given.mVelocity);
    }
    for (const { a, b, rest, compliance } of edges) {
      const edge = Object.assign(new Jolt.SoftBodySharedSettingsEdge(a, b, compliance), { mRestLength: rest });
      shared.mEdgeConstraints.push_back(edge), Jolt.destroy(edge);
    }
    shared.Optimize();  // without it the first step reads out of bounds
    const creation = new Jolt.SoftBodyCreationSettings(shared, new Jolt.RVec3(...origin), this.upright, 0);
    Object.assign(creation, {
      mNumIterations: iterations, mLinearDamping: damping,  // default damping 0.1 / s
      mMaxLinearVelocity: 1e15,   // m/s; default 500, above which vertices are silently slowed down
      mUpdatePosition: false,     // otherwise the frame follows the body, and vertices are rounded again
      mAllowSleeping: false,      // otherwise a body slower than 0.17 m/s for half a second stops
      mFriction: 1, mRestitution: 0 });  // a contact uses sqrt(body's times sphere's), and the larger restitution
    const body = this.bodies.CreateSoftBody(creation);
    this.bodies.AddBody(body.GetID(), Jolt.EActivation_Activate);
    const motion = Jolt.castObject(body.GetMotionProperties(), Jolt.SoftBodyMotionProperties);
    return { body, motion, vertices: vertices.map((_, i) => motion.GetVertex(i)) };
  }

  /// Particles touch a ball at radius + margin, the radius of Jolt's sphere; its vertices have no radius.
  addBall({ centre, radius, margin, friction, restitution }) {
    const shape = new Jolt.SphereShape(radius + margin), position = new Jolt.RVec3(...centre);
    const creation = new Jolt.BodyCreationSettings(shape, position, this.upright, Jolt.EMotionType_Static, 0);
    Object.assign(creation, { mFriction: friction ** 2, mRestitution: restitution });
    const body = this.bodies.CreateBody(creation);
    this.bodies.AddBody(body.GetID(), Jolt.EActivation_DontActivate);
    return body;
  }
}

/// Jolt's edges in the given order; parallel edges keep their own order.
function edgesLike({ motion }, wanted) {
  const edges = motion.GetSettings().mEdgeConstraints, found = new Map();
  for (let i = 0; i < edges.size(); ++i) {
    const edge = edges.at(i), ends = `${edge.get_mVertex(0)} ${edge.get_mVertex(1)}`, same = found.get(ends) ?? [];
    found.set(ends, [...same, { rest_length: edge.mRestLength, stiffness: 1 / edge.mCompliance }]);
  }
  return wanted.map(({ a, b }) => found.get(`${a} ${b}`).shift());
}

/// Spring forces (N) at x as Jolt computes them. Each spring is measured separately, in one step d, between a held
/// vertex and a free vertex at the origin, where small displacements are not rounded away. The compliance is 1e6 w d^2,
/// so the free vertex moves by w d^2 k (L - r) to within a millionth.
function springForces(world, springs, x) {
  const forces = new Float64Array(x.length), d = 2 ** -10, v = [0, 0, 0];
  world.setGravity([0, 0, 0]);
  for (let first = 0; first < springs.length; first += 500) {
    const some = springs.slice(first, first + 500), apart = ({ a, b }) => v.map((_, k) => x[3 * b + k] - x[3 * a + k]);
    const edges = some.map((one, i) => ({ ...one, a: 2 * i, b: 2 * i + 1 })), vertices = some.flatMap((one) => [
      { x: v, v, w: (1e-6 * one.compliance) / (d * d) }, { x: apart(one), v, w: 0 }]);
    const probe = world.addSoftBody({ origin: [0, 0, 0], vertices, edges, iterations: 1, damping: 0 });
    world.jolt.Step(d, 1);
    some.forEach(({ a, b }, i) => {
      const { mPosition: moved, mInvMass: w } = probe.vertices[2 * i];
      components(moved).forEach((e, k) => (forces[3 * a + k] += e / (w * d * d), forces[3 * b + k] -= e / (w * d * d)));
    });
    world.remove(probe.body);
  }
  return forces;
}

serve(description, (scene) => {
  const iterations = scene.option('n', 1), frame = scene.option('frame', ['scene', 'world']), { h, pins } = scene;
  if (scene.spheres.some((ball) => ball.motion))
    unsupported('moving spheres: in contact, Jolt treats the velocity of a kinematic sphere as zero');
  const damping = scene.oneDamping('drag that differs between particles: Jolt has one damping (1/s) per body');
  if (damping * h >= iterations) unsupported('drag that removes all speed in one sub-step');
  const world = new World(), rods = scene.rods.list.map(({ a, b, length: rest }) => ({ a, b, rest, compliance: 0 }));
  world.setGravity(scene.gravity);
  const springs = scene.springs.list.map((one) => ({ ...one, rest: one.rest_length, compliance: 1 / one.stiffness }));
  const points = scene.task.particles.x, axis = [0, 1, 2].map((k) => points.map((p) => p[k]));
  const middle = axis.map((e) => (frame === 'world' ? 0 : Math.fround((Math.min(...e) + Math.max(...e)) / 2)));
  const vertices = points.map((p, i) => ({ x: p.map((e, k) => e - middle[k]), v: scene.v.subarray(3 * i, 3 * i + 3),
                                           w: scene.pinned[i] ? 0 : 1 / scene.mass[i] }));
  const edges = [...springs, ...rods], asked = { origin: middle, vertices, edges, iterations, damping };
  const soft = world.addSoftBody(asked), { body, motion } = soft, origin = components(body.GetCenterOfMassPosition());
  const balls = scene.spheres.map((ball) => world.addBall(ball));
  const gravity = world.gravity().map((g) => g * motion.GetGravityFactor()), links = edgesLike(soft, edges);
  const blow = (t) => world.setGravity(scene.windAt(t).map((e, k) => scene.gravity[k] + e));

  return {
    step(t, next) {
      if (scene.wind) blow(t);
      if (!pins.motion) return void world.jolt.Step(h, 1);
      // a held vertex is moved by setting its velocity; its position is set as well, because n sub-steps would
      // accumulate n rounding errors
      const from = scene.pinsAt(t), to = scene.pinsAt(next), held = to.map(({ particle }) => soft.vertices[particle]);
      held.forEach((one, i) => (one.mVelocity = world.vec3(to[i].x.map((e, k) => (e - from[i].x[k]) / h))));
      world.jolt.Step(h, 1);
      held.forEach((one, i) => (one.mPosition = world.vec3(to[i].x.map((e, k) => e - origin[k]))));
    },
    read(x, v) {  // in the scene's coordinates, summed in double precision
      soft.vertices.forEach((vertex, i) => {
        x.set(components(vertex.mPosition).map((e, k) => origin[k] + e), 3 * i);
        v.set(components(vertex.mVelocity), 3 * i);
      });
    },
    report() {
      const inverse = soft.vertices.map((vertex) => vertex.mInvMass), probe = scene.ownProbe();
      const spheres = balls.map((ball) => ({
        centre: components(ball.GetPosition()), friction: Math.sqrt(ball.GetFriction() * body.GetFriction()),
        radius: Jolt.castObject(ball.GetShape(), Jolt.SphereShape).GetRadius() + motion.GetVertexRadius(),
        restitution: Math.max(ball.GetRestitution(), body.GetRestitution()) }));
      const readback = {
        precision: 'single', mass: inverse.map((w) => (w > 0 ? 1 / w : 0)), pinned: inverse.map((w) => +(w === 0)),
        links: scene.linksRead((i) => links[i]), gravity, drag: inverse.map(() => motion.GetLinearDamping()), spheres,
        may_sleep: motion.GetAllowSleeping(), step: Math.fround(h), later: { centres: spheres.map((e) => e.centre) },
        mapped: { stiffness: 'compliance of an edge, 1 / k (m/N)', drag: 'linear damping (1/s)' }, probe,
        settings: { iterations: `${motion.GetNumIterations()}`, frame } };
      blow(probe.t);
      const extra = world.gravity().map((g, k) => g - gravity[k]);
      probe.wind = Float64Array.from(probe.x, (_, e) => readback.mass[(e / 3) | 0] * extra[e % 3]);
      [body, ...balls].forEach((one) => world.remove(one));
      probe.springs = springForces(world, springs, probe.x);
      // a step ends on the plane that touched the ball where the step began, so the next step begins above the ball;
      // this gap subtracts another half of v^2 / R from the depth that determines friction
      const law = 'friction: on a ball of radius R it is mu m (g_n - 3/2 v^2 / R) with n = 1, not mu m (g_n - v^2 / R)';
      return { force_evaluations: Math.round(scene.times.at(-1) / h) * iterations * 2, readback,
               different_law: scene.spheres.some((ball) => ball.friction > 0) ? [law] : [] };
    },
    free: () => Jolt.destroy(world.jolt),
  };
});
