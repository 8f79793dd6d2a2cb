#!/usr/bin/env node
// cannon-es as an engine of crosscheck (PROTOCOL.md): particles are bodies with the shape Particle.
//
// cannon's rule is symplectic Euler in double precision: v = v (1 - d)^h + h f / m, then x += h v, where d is a body's
// linear damping. The drag gamma = c / m (1/s) becomes d = 1 - exp(-gamma), so a step multiplies v by exp(-gamma h).
//
// Options: springs=spring|distance (class Spring, or distance constraints as in cannon's cloth example, which enforce
// the rest lengths), iterations=N (of the solver, default 10 as in cannon), damping=zero|as-written. cannon interprets
// `new Spring(a, b, { damping: 0 })` as 1 N s/m and `stiffness: 0` as 100 N/m; damping=zero sets both to 0 afterwards.
import * as CANNON from 'cannon-es';
import { serve, unsupported } from '../protocol/crosscheck_engine.mjs';

const description = {
  engine: 'cannon-es 0.20.0',
  terms: ['springs', 'dashpots', 'constraints', 'gravity', 'drag', 'wind', 'sphere', 'plane'],
  lacks: { bending: 'it has only springs and distance constraints' },
};
const { KINEMATIC, DYNAMIC } = CANNON.Body, vec3 = (v, i = 0) => new CANNON.Vec3(v[3 * i], v[3 * i + 1], v[3 * i + 2]);
const components = ({ x, y, z }) => [x, y, z], ball_group = 1, obstacle_group = 2;
function place(body, x, v) {
  body.position.set(...x);
  body.velocity.set(...v);
}

/// Particles have no size in cannon.
function particles(scene) {
  const shape = new CANNON.Particle(), material = new CANNON.Material({ friction: 1, restitution: 1 });
  return Array.from(scene.pinned, (held, i) => new CANNON.Body({
    mass: held ? 0 : scene.mass[i], type: held ? KINEMATIC : DYNAMIC, position: vec3(scene.x, i),
    velocity: vec3(scene.v, i), shape, material, fixedRotation: true, angularDamping: 0,
    linearDamping: held ? 0 : -Math.expm1(-scene.damping[i]),
    collisionFilterGroup: ball_group, collisionFilterMask: obstacle_group }));
}

/// An obstacle that particles touch at the scene's distance. A contact multiplies the coefficients of both bodies.
function obstacle(of) {
  const { friction, restitution, radius, margin, normal } = of, z = new CANNON.Vec3(0, 0, 1);
  const shape = normal ? new CANNON.Plane() : new CANNON.Sphere(radius + margin);
  const material = new CANNON.Material({ friction, restitution });
  const body = new CANNON.Body({ mass: 0, type: KINEMATIC, shape, material,
                                 collisionFilterGroup: obstacle_group, collisionFilterMask: ball_group });
  if (normal) body.quaternion.setFromVectors(z, vec3(normal));
  return { body, of, shape, read: () => {
    const at = components(body.position), where = normal ? { point: at, normal: components(body.quaternion.vmult(z)) }
                                                         : { centre: at, radius: shape.radius };
    return { ...where, friction: material.friction, restitution: material.restitution };
  } };
}

serve(description, (scene) => {
  const kind = scene.option('springs', ['spring', 'distance']), iterations = scene.option('iterations', 10);
  const written = scene.option('damping', ['zero', 'as-written']) === 'as-written', { h } = scene;
  if (written && scene.dashpots.count) unsupported('damping=as-written does not support dashpots');
  CANNON.Body.idCounter = 0;  // body numbers must not depend on earlier scenes
  const world = new CANNON.World({ gravity: vec3(scene.gravity), allowSleep: false }), bodies = particles(scene);
  world.solver.iterations = iterations;
  const spheres = scene.spheres.map(obstacle), planes = scene.planes.map(obstacle), obstacles = [...spheres, ...planes];
  for (const body of [...bodies, ...obstacles.map((one) => one.body)]) world.addBody(body);
  world.broadphase.collisionPairs = (_, first, second) => {  // cannon's own function also forms all pairs of particles
    for (const one of obstacles) for (const body of bodies) first.push(one.body), second.push(body);
  };
  const lead = (t, next) => {
    for (const { body, of } of obstacles) {
      const [from, to] = [t, next].map((time) => scene.obstacleAt(of, time, of.margin));
      place(body, from, to.map((e, k) => (e - from[k]) / h));
    }
  };
  lead(0, h);
  const touched = { spheres: spheres.map((one) => one.read()), planes: planes.map((one) => one.read()) };

  const spring = (a, b, stiffness, damping, restLength) => {
    const made = new CANNON.Spring(bodies[a], bodies[b], { stiffness, damping, restLength });
    return written ? made : Object.assign(made, { stiffness, damping });
  };
  const distance = (a, b, length) => {
    const made = new CANNON.DistanceConstraint(bodies[a], bodies[b], length);
    world.addConstraint(made);
    return made;
  };
  const springs = scene.springs.list.map(({ a, b, stiffness, rest_length: rest }) =>
    kind === 'spring' ? spring(a, b, stiffness, 0, rest) : distance(a, b, rest));
  const links = [...springs, ...scene.rods.list.map(({ a, b, length }) => distance(a, b, length))];
  const dashpots = scene.dashpots.list.map(({ a, b, coefficient }) => spring(a, b, 0, coefficient, 0));
  const pulling = [...springs, ...dashpots].filter((one) => one instanceof CANNON.Spring);
  const pull = () => pulling.forEach((one) => one.applyForce());
  const blow = (t) => {
    const w = scene.wind && vec3(scene.windAt(t));
    if (w) for (const body of bodies) body.force.addScaledVector(body.mass, w, body.force);
  };
  /// Forces that `act` exerts on the bodies, as a flat array.
  const forces = (act) => {
    bodies.forEach((body) => body.force.setZero());
    act();
    return Float64Array.from(bodies.flatMap((body) => components(body.force)));
  };
  /// Forces of cannon's own objects, except those that are reported as a different law.
  const probe = () => {
    const state = scene.probeState();
    bodies.forEach((body, i) => place(body, components(vec3(state.x, i)), [0, 0, 0]));
    const springs = forces(pull), wind = forces(() => blow(state.t));
    bodies.forEach((body, i) => body.velocity.copy(vec3(state.v, i)));
    const dashpots = forces(pull).map((f, i) => f - springs[i]);
    return { ...state, wind, ...(kind === 'spring' ? { springs } : {}), ...(written ? {} : { dashpots }) };
  };
  const different_law = [];
  if (kind === 'distance' && springs.length)
    different_law.push('springs: distance constraints that keep the rest lengths, regardless of the stiffness');
  if (written && pulling.length) different_law.push('dashpots: 1 N s/m in each spring, by damping: 0 of its options');
  if (obstacles.some(({ of }) => of.friction > 0))
    different_law.push('friction: at most mu m |g|, regardless of the normal force');

  return {
    step(t, next) {
      pull();
      blow(t);
      lead(t, next);
      world.step(h);
      if (scene.pins.motion) for (const { particle, x, v } of scene.pinsAt(next)) place(bodies[particle], x, v);
    },
    read(x, v) {
      bodies.forEach(({ position, velocity }, i) => {
        position.toArray().forEach((e, k) => (x[3 * i + k] = e));
        velocity.toArray().forEach((e, k) => (v[3 * i + k] = e));
      });
    },
    report() {
      const t = scene.times.at(-1), passes = links.length > springs.length || kind === 'distance' ? 1 + iterations : 1;
      lead(t, t + h);
      const later = { centres: spheres.map((one) => one.read().centre), points: planes.map((one) => one.read().point) };
      return { force_evaluations: Math.round(t / h) * passes, different_law, readback: {
        precision: 'double', mass: bodies.map(({ mass }) => mass), pinned: bodies.map((body) => +(body.invMass === 0)),
        links: scene.linksRead((i) => ({ rest_length: links[i].restLength ?? links[i].distance,
                                         stiffness: links[i].stiffness })),
        gravity: components(world.gravity), drag: bodies.map((body) => -Math.log1p(-body.linearDamping)), ...touched,
        later, may_sleep: world.allowSleep, probe: probe(), settings: { iterations: `${world.solver.iterations}` },
        mapped: { drag: 'linear damping 1 - exp(-c / m)', spheres: 'spheres of radius + margin' } } };
    },
  };
});
