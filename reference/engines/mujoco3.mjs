#!/usr/bin/env node
// MuJoCo 3 (the official WebAssembly build) as an engine of crosscheck (PROTOCOL.md), in double precision. A particle
// is a body on three slide joints, whose damping is the drag.
//
// Options: integrator=euler|rk4|implicit|implicitfast, springs=tendon|flex (spatial tendons, or edges of
// one-dimensional flexes, one per stiffness), eulerdamp=enable|disable, timeconst=S (of contacts and constraints,
// default 0.02 as in MuJoCo; at least two steps). MuJoCo's Euler is symplectic Euler with implicit drag, v = (v + h f /
// m) / (1 + h c / m); with eulerdamp=disable, drag is explicit, as in mysim. The implicit integrators treat springs
// explicitly. MuJoCo ignores the velocities of moved bodies.
import load from '@mujoco/mujoco';
import wasmBinary from '@mujoco/mujoco/mujoco.wasm';
import { serve, unsupported } from '../protocol/crosscheck_engine.mjs';

let MuJoCo;
const description = {
  engine: 'MuJoCo 3.14.0',
  terms: ['springs', 'dashpots', 'constraints', 'gravity', 'drag', 'wind', 'sphere', 'plane'],
  lacks: { bending: 'its flexes bend by the angles of triangles, not by a rigidity in N m' },
  init: async () => (MuJoCo = await load({ wasmBinary })),
};
const integrators = { euler: 'Euler', rk4: 'RK4', implicit: 'implicit', implicitfast: 'implicitfast' };
const text = (v) => Array.from(v).join(' ');
/// Damping ratio of a contact that returns the fraction e of the speed, and the inverse of this function.
const ratio = (e) => (e > 0 ? -Math.log(e) / Math.hypot(Math.PI, Math.log(e)) : 1);
const bounce = (zeta) => (zeta < 1 ? Math.exp((-Math.PI * zeta) / Math.sqrt(1 - zeta * zeta)) : 0);

/// One flex per stiffness.
function flexes({ list }) {
  return [...new Set(list.map((one) => one.stiffness))].map((k) => {
    const some = list.filter((one) => one.stiffness === k), ends = some.flatMap(({ a, b }) => [a, b]);
    const used = [...new Set(ends)], at = new Map(used.map((particle, i) => [particle, i]));
    return `<flex name="k${k}" dim="1" radius="1e-9" body="${text(used.map((i) => `p${i}`))}"
      element="${text(ends.map((i) => at.get(i)))}"><edge stiffness="${k}"/>
      <contact contype="0" conaffinity="0" selfcollide="none" internal="false"/></flex>`;
  }).join('');
}

/// The scene in MuJoCo's XML. Particles are balls whose radius is the smallest margin; the rest of each margin is added
/// to the obstacle.
function modelText(scene, { integrator, eulerdamp, flex, timeconst }) {
  const { x, mass, drag, pinned, springs, dashpots, rods } = scene, obstacles = [...scene.spheres, ...scene.planes];
  const size = Math.min(...obstacles.map(({ margin }) => margin)) || scene.task.size / 1000;
  const touching = obstacles.length ? `<geom type="sphere" size="${size}" contype="1" conaffinity="0"/>` : '';
  const slide = (i, k) => `<joint type="slide" axis="${text([0, 1, 2].map((e) => +(e === k)))}"
    ref="${x[3 * i + k]}" damping="${drag[i]}"/>`;
  const body = (held, i) => `<body name="p${i}" pos="${text(x.subarray(3 * i, 3 * i + 3))}"
    ${held && scene.pins.motion ? 'mocap="true"' : ''}><site name="s${i}"/>${held ? '' : `${[0, 1, 2].map((k) =>
      slide(i, k)).join('')}<inertial pos="0 0 0" mass="${mass[i]}" diaginertia="1 1 1"/>${touching}`}</body>`;
  const tendon = (name) => ({ a, b, stiffness = 0, rest_length = -1, coefficient = 0 }, i) =>
    `<spatial name="${name}${i}" stiffness="${stiffness}" springlength="${rest_length}" damping="${coefficient}">
      <site site="s${a}"/><site site="s${b}"/></spatial>`;
  const obstacle = (of) => {
    const place = text(scene.obstacleAt(of, 0, of.margin - size)), law = `contype="0" conaffinity="1" priority="1"
      solref="${timeconst} ${ratio(of.restitution)}" friction="${of.friction} 0 0" condim="${of.friction > 0 ? 3 : 1}"`;
    return of.normal ? `<geom type="plane" name="" size="1 1 1" pos="${place}" zaxis="${text(of.normal)}" ${law}/>`
                     : `<geom type="sphere" size="${of.radius + of.margin - size}" pos="${place}" ${law}/>`;
  };
  return `<mujoco><option timestep="${scene.h}" gravity="${text(scene.gravity)}" cone="elliptic"
    integrator="${integrators[integrator]}"><flag eulerdamp="${eulerdamp}" autoreset="disable"/></option>
    <worldbody>${obstacles.map(obstacle).join('')}${Array.from(pinned, body).join('')}</worldbody>
    <tendon>${flex ? '' : springs.list.map(tendon('spring')).join('')}${rods.list.map(tendon('rod')).join('')}
    ${dashpots.list.map(tendon('dashpot')).join('')}</tendon>
    <equality>${rods.list.map((_, i) => `<tendon tendon1="rod${i}" solref="${timeconst} 1"/>`).join('')}</equality>
    <deformable>${flex ? flexes(springs) : ''}</deformable></mujoco>`;
}

/// Edges of the flexes in the order of the springs. Sets their rest lengths; MuJoCo itself uses the initial lengths.
function flexEdges(model, { list }) {
  const name = (a, b) => (a < b ? `${a} ${b}` : `${b} ${a}`), at = new Map(list.map(({ a, b }, i) => [name(a, b), i]));
  const edges = [], { flex_edge: ends, flexedge_length0: rests, flex_vertbodyid: bodies, flex_vertadr: first } = model;
  if (at.size < list.length) unsupported('springs=flex: two springs between the same particles');
  model.flex_edgenum.forEach((count, flex) => {
    for (let e = model.flex_edgeadr[flex], end = e + count; e < end; ++e) {
      const [a, b] = [0, 1].map((side) => bodies[first[flex] + ends[2 * e + side]] - 1), i = at.get(name(a, b));
      rests[e] = list[i].rest_length;
      edges[i] = { rest_length: rests[e], stiffness: model.flex_edgestiffness[flex] };
    }
  });
  return edges;
}

serve(description, (scene) => {
  const integrator = scene.option('integrator', Object.keys(integrators)), rk4 = integrator === 'rk4';
  const flex = scene.option('springs', ['tendon', 'flex']) === 'flex', { pins, springs, dashpots, rods, count } = scene;
  const eulerdamp = scene.option('eulerdamp', ['enable', 'disable']), timeconst = scene.option('timeconst', 0.02);
  const obstacles = [...scene.spheres, ...scene.planes], led = (i) => pins.motion && scene.pinned[i];
  if (obstacles.some((one) => one.motion || one.velocity)) unsupported('moving obstacles: MuJoCo sees no velocity');
  if (dashpots.list.some((one) => led(one.a) || led(one.b))) unsupported('dashpots at moved pins: it sees no velocity');
  if (obstacles.length + rods.count && timeconst < 2 * scene.h) unsupported(`timeconst=${timeconst}: below two steps`);
  const model = MuJoCo.MjModel.from_xml_string(modelText(scene, { integrator, eulerdamp, flex, timeconst }));
  const data = new MuJoCo.MjData(model), edges = flex ? flexEdges(model, springs) : [];
  const dofs = Array.from(model.body_dofadr.subarray(1, count + 1));  // first degree of freedom by particle, or -1
  /// Calls act(index in the scene's flat arrays, index in MuJoCo's) for each coordinate of the free particles.
  const each = (act) => dofs.forEach((at, i) => at < 0 || [0, 1, 2].forEach((k) => act(3 * i + k, at + k)));
  const mocap = (t) => {
    for (const { particle, x } of pins.motion ? scene.pinsAt(t) : [])
      data.mocap_pos.set(x, 3 * model.body_mocapid[particle + 1]);
  };
  const { qvel: begin } = data, gravity = [...model.opt.gravity];
  each((e, at) => (begin[at] = scene.v[e]));
  mocap(0);

  const tendon = (i) => ({ stiffness: model.tendon_stiffness[i], rest_length: model.tendon_lengthspring[2 * i] });
  const rod = (i) => ({ rest_length: model.tendon_length0[flex ? i - springs.count : i] });
  /// Passive forces computed by MuJoCo; held particles are at their initial positions, at rest.
  const probe = () => {
    const state = scene.ownProbe(), { qpos, qvel, qfrc_spring, qfrc_damper } = data;
    scene.placePins(0, state.x, state.v), mocap(0);
    each((e, at) => ([qpos[at], qvel[at], model.dof_damping[at]] = [state.x[e], state.v[e], 0]));
    MuJoCo.mj_forward(model, data);
    state.springs.fill(0), state.dashpots.fill(0);
    each((e, at) => ([state.springs[e], state.dashpots[e]] = [qfrc_spring[at], qfrc_damper[at]]));
    return state;
  };
  const different_law = [], soft = `soft, with a time constant of ${timeconst} s`;
  if (obstacles.length) different_law.push(`contact: ${soft}`);
  if (rods.count) different_law.push(`constraints: ${soft}`);
  if (rk4 && (pins.motion || scene.wind?.gusts)) different_law.push('motion: RK4 freezes pins and gusts in each step');

  return {
    step(t, next) {
      if (scene.wind) model.opt.gravity.set(scene.windAt(t).map((e, k) => e + scene.gravity[k]));
      MuJoCo.mj_step(model, data);
      mocap(next);
    },
    read(x, v, t) {
      const { qpos, qvel } = data;
      each((e, at) => ([x[e], v[e]] = [qpos[at], qvel[at]]));
      scene.placePins(t, x, v);
    },
    report() {
      const law = (i) => ({ friction: model.geom_friction[3 * i], restitution: bounce(model.geom_solref[2 * i + 1]) });
      const at = (i, k) => model.geom_pos[3 * i + k], size = model.geom_size.at(-3) ?? 0, m = model.body_mass;
      const spheres = scene.spheres.map((_, i) => ({
        centre: [0, 1, 2].map((k) => at(i, k)), radius: model.geom_size[3 * i] + size, ...law(i) }));
      const planes = scene.planes.map((_, j) => spheres.length + j).map((i) => {
        const normal = [2, 5, 8].map((k) => data.geom_xmat[9 * i + k]);
        return { point: normal.map((e, k) => at(i, k) + size * e), normal, ...law(i) };
      });
      const readback = {
        precision: 'double', mass: m.subarray(1), pinned: dofs.map((dof) => +(dof < 0)), may_sleep: false,
        links: scene.linksRead((i, _, hard) => (hard ? rod(i) : flex ? edges[i] : tendon(i))), spheres, planes, gravity,
        drag: dofs.map((dof, i) => (dof < 0 ? 0 : model.dof_damping[dof] / m[i + 1])),
        mapped: { drag: 'damping of slide joints' }, settings: { version: MuJoCo.mj_versionString(), cone: 'elliptic' },
        later: { centres: spheres.map((one) => one.centre), points: planes.map((one) => one.point) } };
      const force_evaluations = Math.round(scene.times.at(-1) / scene.h) * (rk4 ? 4 : 1);
      return { force_evaluations, different_law, readback: { ...readback, probe: probe() } };
    },
    free: () => [data, model].forEach((one) => one.delete()),
  };
});
