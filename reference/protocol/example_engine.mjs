#!/usr/bin/env node
// An engine for crosscheck in JavaScript (Node, no packages): symplectic Euler with springs, dashpots, drag, gravity, wind.
import { readFileSync, writeFileSync } from 'node:fs';
const task = JSON.parse(readFileSync(process.argv[2], 'utf8')), out = process.argv[3];
const terms = Object.fromEntries(task.terms.map((t) => [t.type, t])), known = ['springs', 'dashpots', 'drag', 'gravity', 'wind'];
const lacking = Object.keys(terms).filter((type) => !known.includes(type));
if (lacking.length) { console.error('this example has no ' + lacking.join(', ')); process.exit(3); }
const { step: h, steps_per_sample: perSample, samples } = task.run, { mass, pinned, count } = task.particles;
const x = task.particles.x.map((p) => [...p]), v = task.particles.v.map((p) => [...p]);
const springs = terms.springs?.list ?? [], dashpots = terms.dashpots?.list ?? [];
const g = terms.gravity?.acceleration ?? [0, 0, 0], c = terms.drag?.coefficient ?? mass.map(() => 0), pins = task.pins?.particles ?? [];
const zeros = () => mass.map(() => [0, 0, 0]), sum = (a, b, s = 1) => a.forEach((_, k) => { a[k] += s * b[k]; });
const waves = (list, t) => list.reduce((s, w) => s + w.weight * Math.sin(w.omega * t + w.phase), 0);

function pairForce(f, x, a, b, pull) {  // pull(distance, unit vector): N along the line
  const d = x[a].map((_, k) => x[a][k] - x[b][k]), l = Math.hypot(...d) || Infinity;  // coincident ends get no force
  const n = d.map((e) => e / l), p = l < Infinity ? pull(l, n) : 0;
  sum(f[a], n, -p), sum(f[b], n, p);
}
function springForce(x, f = zeros()) {
  const hooke = terms.springs?.law !== 'bullet-link';
  for (const { a, b, stiffness: k, rest_length: r } of springs)
    pairForce(f, x, a, b, (l) => (hooke ? k * (l - r) : (k * l * (l * l - r * r)) / (l * l + r * r)));
  return f;
}
function dashpotForce(x, v, f = zeros()) {
  for (const { a, b, coefficient } of dashpots)
    pairForce(f, x, a, b, (_, n) => coefficient * n.reduce((s, e, k) => s + e * (v[a][k] - v[b][k]), 0));
  return f;
}
function windForce(t) {
  const w = terms.wind, gusts = w?.gusts, along = gusts ? 1 + gusts.variation * waves(gusts.along, t) : 1;
  const blow = w ? w.acceleration.map((e, k) => e * along + (gusts ? gusts.side[k] * waves(gusts.across, t) : 0)) : [0, 0, 0];
  return mass.map((m) => blow.map((e) => m * e));
}
function placePins(t) {
  const move = task.pins?.motion, s = move ? Math.min(t / move.ramp, 1) : 0, w = move ? 2 * Math.PI * move.frequency : 0;
  const r = s ** 3 * (10 + s * (6 * s - 15)), slope = s < 1 && move ? (30 * s * s * (1 - s) ** 2) / move.ramp : 0;
  const led = r * Math.sin(w * t), speed = slope * Math.sin(w * t) + r * w * Math.cos(w * t);
  pins.forEach((pin, i) => [0, 1, 2].forEach((k) => {
    x[pin][k] = task.pins.home[i][k] + (move ? move.amplitude[k] * led : 0); v[pin][k] = move ? move.amplitude[k] * speed : 0; }));
}
const frames = [x.flat()], speeds = [v.flat()], begin = process.cpuUsage(), steps = samples * perSample;
for (let i = 1; i <= steps; ++i) {
  const f = dashpotForce(x, v, springForce(x)), wind = windForce((i - 1) * h);
  for (let p = 0; p < count; ++p) for (let k = 0; k < 3; ++k) {
    v[p][k] += h * (g[k] + (f[p][k] + wind[p][k] - c[p] * v[p][k]) / mass[p]); x[p][k] += h * v[p][k]; }
  placePins(i * h);
  if (i % perSample === 0) { frames.push(x.flat()); speeds.push(v.flat()); }
}
function npy(file, frames) {
  const words = `{'descr': '<f8', 'fortran_order': False, 'shape': (${frames.length}, ${count}, 3), }`.padEnd(117) + '\n';
  writeFileSync(file, Buffer.concat([Buffer.from('\x93NUMPY\x01\x00\x76\x00', 'latin1'), Buffer.from(words), Buffer.from(new Float64Array(frames.flat()).buffer)]));
}
const used = process.cpuUsage(begin), px = task.particles.x.map((p) => p.map((e) => 1.1 * e)), pv = task.particles.x.map((p) => p.map((e) => 0.5 * e));
npy(out + '/trajectory.npy', frames); npy(out + '/velocities.npy', speeds);
writeFileSync(out + '/run.json', JSON.stringify({ cpu_seconds: (used.user + used.system) / 1e6, steps, force_evaluations: steps, readback: {
  precision: 'double', mass, pinned, links: springs, gravity: g, drag: c.map((e, i) => e / mass[i]), spheres: [], may_sleep: false, step: h,
  start: { x: task.particles.x, v: task.particles.v }, later: { t: steps * h, pins: pins.map((pin) => x[pin]), centres: [] },
  probe: { t: 0.3, x: px, v: pv, springs: springForce(px), dashpots: dashpotForce(px, pv), wind: windForce(0.3) } } }));
