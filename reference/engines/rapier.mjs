#!/usr/bin/env node
// Rapier as an engine of crosscheck (PROTOCOL.md), in single precision: particles are rigid bodies that cannot rotate.
//
// A step h has n sub-steps (Rapier's solver iterations). Options: n=N (default 4 as in Rapier),
// springs=joint|softbody|forces:
// - joint: spring joints, soft constraints that are implicit along the line at the step's start, explicit across it;
// - softbody: edges of a soft body, each with a frequency and a damping ratio; rest lengths are the initial ones;
// - forces: computed by this adapter, applied by addForce. Rapier repeats a step's force in each sub-step, so x moves
//   by h v + h^2 a (n + 1) / (2n) instead of h v + h^2 a: energy grows unless n = 1.
// Drag is linear damping: v is divided by 1 + gamma h / n in each sub-step.
import RAPIER from '@dimforge/rapier3d-compat';
import { serve, unsupported } from '../protocol/crosscheck_engine.mjs';

const description = {
  engine: 'Rapier 0.21.0',
  terms: ['springs', 'dashpots', 'bending', 'gravity', 'drag', 'wind', 'sphere', 'plane'],
  lacks: { constraints: 'its rope joint limits a distance from above only' },
  laws: ['hooke', 'bullet-link'], init: () => RAPIER.init(),
};
const vec3 = (v, i = 0) => ({ x: v[3 * i], y: v[3 * i + 1], z: v[3 * i + 2] }), origin = vec3([0, 0, 0]);
const components = ({ x, y, z }) => [x, y, z];
const led = 'kinematicPositionBased', ball_groups = 0x00010002, obstacle_groups = 0x00020001;  // memberships, filter

function newWorld(gravity, h, n) {
  return Object.assign(new RAPIER.World(vec3(gravity)), { timestep: h, numSolverIterations: n });
}
const joint = ({ rest, k, c }) => RAPIER.JointData.spring(rest, k, c, origin, origin);
/// A free particle (with a mass, kg) or a held one.
function particle(world, x, v, mass, motion) {
  const desc = RAPIER.RigidBodyDesc[mass ? 'dynamic' : motion ?? 'fixed']().setAdditionalMass(mass);
  return world.createRigidBody(desc.setTranslation(...x).setLinvel(...v).lockRotations().setCanSleep(false));
}

/// Forces (N) of the links at x and v as Rapier computes them. Each link is measured separately, in one short step d,
/// between a held particle and a free one at the origin. The free one, of mass m = 1e6 (d^2 k + d c), hardly moves.
function measuredForces(links, x, v) {
  const forces = new Float64Array(x.length), d = 2 ** -10, world = newWorld([0, 0, 0], d, 1);
  const apart = (array, { a, b }) => [0, 1, 2].map((k) => array[3 * b + k] - array[3 * a + k]);
  const free = links.map((link) => {
    const body = particle(world, [0, 0, 0], [0, 0, 0], 1e6 * (d * d * link.k + d * link.c));
    const held = particle(world, apart(x, link), apart(v, link), 0, 'kinematicVelocityBased');
    world.createImpulseJoint(joint(link), body, held, true);
    return body;
  });
  world.step();
  links.forEach(({ a, b }, i) => components(free[i].linvel()).forEach((e, k) => {
    forces[3 * a + k] += (e * free[i].mass()) / d;
    forces[3 * b + k] -= (e * free[i].mass()) / d;
  }));
  world.free();
  return forces;
}

/// Soft body of the springs. An edge's softness is the frequency (Hz) and damping ratio of its two particles.
function softBody(world, scene, springs) {
  const { x, mass, pinned: p } = scene, w = (i) => (p[i] ? 0 : 1 / mass[i]), ends = springs.flatMap((s) => [s.a, s.b]);
  const hertz = ({ a, b, k }) => Math.sqrt(k * (w(a) + w(b))) / (2 * Math.PI);
  const gamma = scene.oneDamping('springs=softbody: drag that differs between particles');
  if (scene.dashpots.count) unsupported('springs=softbody: dashpots without springs');
  if (scene.spheres.length + scene.planes.length) unsupported('springs=softbody: no contact without a surface');
  if (springs.some((one) => !(Math.abs(scene.lengthOf(one) - one.rest) <= 1e-6 * one.rest)))
    unsupported('springs=softbody: edges take their rest lengths from the start, which is not at rest here');
  const body = world.createSoftBody(new RAPIER.SoftBodyDesc(Float32Array.from(x)).setMasses(Float32Array.from(mass))
    .setEdges(ends).setEdgeSoftness(ends, springs.map((one) => ({ naturalFrequency: hertz(one), dampingRatio: 0 })))
    .setPinnedParticles([...p.keys()].filter((i) => p[i])).setLinearDamping(gamma).setNoSurfaceCollider()
    .setCanSleep(false));
  p.forEach((held, i) => held || body.setParticleVelocity(i, vec3(scene.v, i)));
  return body;
}

/// Adds colliders for particles and obstacles, and reads the obstacles back. Particles are balls whose radius is the
/// smallest margin; the rest of each margin is added to the obstacle.
function addContacts(world, scene, bodies) {
  const all = [...scene.spheres, ...scene.planes], { Max } = RAPIER.CoefficientCombineRule, { ColliderDesc } = RAPIER;
  const size = Math.min(...all.map((one) => one.margin)) || scene.task.size / 1000;
  const add = (shape, { friction = 0, restitution = 0 }, groups, parent) => world.createCollider(shape.setDensity(0)
    .setFriction(friction).setFrictionCombineRule(Max).setRestitution(restitution).setRestitutionCombineRule(Max)
    .setCollisionGroups(groups), parent);
  const balls = all.length ? bodies.map((one) => add(ColliderDesc.ball(size), {}, ball_groups, one)) : [];
  const obstacles = all.map((of) => {
    const at = (t) => scene.obstacleAt(of, t, of.margin - size), { normal } = of;
    const half = normal && new ColliderDesc(new RAPIER.HalfSpace(vec3(normal)));
    const shape = half ?? ColliderDesc.ball(of.radius + of.margin - size);
    const made = add(shape, of, obstacle_groups, particle(world, at(0), [0, 0, 0], 0, led)), { shape: read } = made;
    const place = () => components(made.translation()).map((e, k) => e + (normal ? balls[0].radius() * normal[k] : 0));
    const where = normal ? { point: place(), normal: components(read.normal) }
                         : { centre: place(), radius: made.radius() + balls[0].radius() };
    const told = { ...where, friction: made.friction(), restitution: made.restitution() };
    return { normal, place, told, lead: (t) => made.parent().setNextKinematicTranslation(vec3(at(t))) };
  });
  return [obstacles.filter(({ normal }) => !normal), obstacles.filter(({ normal }) => normal)];
}

serve(description, (scene) => {
  const n = scene.option('n', 4), kind = scene.option('springs', ['joint', 'softbody', 'forces']), { pinned } = scene;
  const own = kind === 'forces', soft = kind === 'softbody', size = 3 * scene.count, all = [...pinned.keys()];
  const springs = scene.springs.list.map((one) => ({ ...one, rest: one.rest_length, k: one.stiffness, c: 0 }));
  const dashpots = scene.dashpots.list.map((one) => ({ ...one, rest: 0, k: 0, c: one.coefficient }));
  if (!own && scene.bending.length) unsupported('bending needs springs=forces: Rapier has no rigidity in N m');
  if (!own && scene.springs.law !== 'hooke') unsupported(`springs of the law ${scene.springs.law} need springs=forces`);
  const world = newWorld(scene.gravity, scene.h, n), body = soft && softBody(world, scene, springs);
  const at = (flat, i) => components(vec3(flat, i)), held = scene.pins.motion && led;
  const bodies = soft ? [] : all.map((i) =>
    particle(world, at(scene.x, i), at(scene.v, i), pinned[i] ? 0 : scene.mass[i], held));
  bodies.forEach((one, i) => one.setLinearDamping(scene.damping[i]));
  for (const one of own || soft ? [] : [...springs, ...dashpots])
    world.createImpulseJoint(joint(one), bodies[one.a], bodies[one.b], true);
  const [spheres, planes] = addContacts(world, scene, bodies);
  const [x, v, f, still] = Array.from({ length: 4 }, () => new Float64Array(size)), target = vec3(f);
  const read = (x, v) => {
    if (soft) x.set(body.particlePositions()), v.set(body.particleVelocities());
    for (let i = 0; i < bodies.length; ++i) {
      ({ x: x[3 * i], y: x[3 * i + 1], z: x[3 * i + 2] } = bodies[i].translation(target));
      ({ x: v[3 * i], y: v[3 * i + 1], z: v[3 * i + 2] } = bodies[i].linvel(target));
    }
  };
  return {
    step(t, next) {
      if (scene.wind) world.gravity = vec3(scene.windAt(t).map((e, k) => e + scene.gravity[k]));
      if (own) {
        read(x, v);
        f.fill(0);
        scene.addSpringForces(x, f), scene.addDashpotForces(x, v, f), scene.addBendingForces(x, f);
        bodies.forEach((one, i) => (one.resetForces(false), one.addForce(vec3(f, i), true)));
      }
      for (const pin of held ? scene.pinsAt(next) : [])
        if (soft) body.setParticleKinematicTarget(pin.particle, vec3(pin.x));
        else bodies[pin.particle].setNextKinematicTranslation(vec3(pin.x));
      for (const one of [...spheres, ...planes]) one.lead(next);
      world.step();
    },
    read,
    report() {
      const probe = scene.ownProbe(), measure = (...of) => (soft ? undefined : measuredForces(...of));
      if (!own)
        [probe.springs, probe.dashpots] = [measure(springs, probe.x, still), measure(dashpots, probe.x, probe.v)];
      return { force_evaluations: Math.round(scene.times.at(-1) / scene.h) * (own ? 1 : 2 * n), readback: {
        precision: 'single', gravity: scene.gravity.map(Math.fround), probe, may_sleep: false,
        spheres: spheres.map(({ told }) => told), planes: planes.map(({ told }) => told),
        mass: all.map((i) => (soft ? body.particleMass(i) : bodies[i].mass())),
        pinned: all.map((i) => +(soft ? body.isParticlePinned(i) : !bodies[i].isDynamic())),
        links: scene.linksRead((i, { rest_length }) => ({ rest_length: soft ? body.edgeRestLength(i) : rest_length })),
        drag: all.map((i) => (soft ? body : bodies[i]).linearDamping()),
        later: { centres: spheres.map((one) => one.place()), points: planes.map((one) => one.place()) },
        mapped: { particles: 'bodies without rotation', drag: 'linear damping (1/s)', wind: 'gravity of each step' },
        settings: { version: RAPIER.version(), 'solver iterations': `${world.numSolverIterations}` } } };
    },
    free: () => world.free(),
  };
});
