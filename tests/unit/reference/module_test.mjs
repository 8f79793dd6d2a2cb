// Tests crosscheck_engine.mjs. Exits with 0 if all assertions hold, otherwise stops at the first failure.
import assert from 'node:assert/strict';
import { motionAt, Scene } from '../../../reference/protocol/crosscheck_engine.mjs';

const run = { step: 0.1, steps_per_sample: 1, samples: 1, times: [0, 0.1] };
function sceneOf({ x, pinned = x.map(() => 0), terms = [], options = [], pins }) {
  const particles = { count: x.length, x, v: x.map(() => [0, 0, 0]), mass: x.map((_, i) => i + 1), pinned };
  return new Scene({ run, particles, terms, options, pins, size: 1 });
}

// velocity and acceleration of a motion are its derivatives, during the ramp and after it
const motion = { amplitude: [0.3, -0.2, 0.1], frequency: 0.7, ramp: 1.5 }, d = 1e-5;  // m, Hz, s, s
for (const t of [0, 0.2, 0.75, 1.4, 1.6, 3]) {
  const [before, now, after] = [t - d, t, t + d].map((time) => motionAt(motion, time));
  for (let k = 0; t > 0 && k < 3; ++k) {
    assert(Math.abs((after.displacement[k] - before.displacement[k]) / (2 * d) - now.velocity[k]) < 1e-8);
    assert(Math.abs((after.velocity[k] - before.velocity[k]) / (2 * d) - now.acceleration[k]) < 1e-7);
  }
}
assert.deepEqual(motionAt(undefined, 1).velocity, [0, 0, 0]);

// springs: tension k (L - r), no force for coincident ends, which are counted; the bullet-link law
const x = [[0, 0, 0], [0, 2, 0], [0, 2, 0]], f = new Float64Array(9);
const list = [{ a: 0, b: 1, stiffness: 10, rest_length: 1.5 }, { a: 1, b: 2, stiffness: 10, rest_length: 1 }];
const hooke = sceneOf({ x, terms: [{ type: 'springs', law: 'hooke', list }] });
assert.equal(hooke.addSpringForces(hooke.x, f), 1);
assert.deepEqual([...f], [0, 5, 0, 0, -5, 0, 0, 0, 0]);
const link = sceneOf({ x, terms: [{ type: 'springs', law: 'bullet-link', list: list.slice(0, 1) }] }), g = new Float64Array(9);
link.addSpringForces(link.x, g);
assert(Math.abs(g[1] - (10 * 2 * (4 - 2.25)) / (4 + 2.25)) < 1e-14);

// options: defaults, values, and refusals that name the expected values
const asked = sceneOf({ x, options: ['n=3', 'rule=b', 'm=2.5', 'fast'] });
assert.equal(asked.option('n', 1), 3);
assert.equal(asked.option('rule', ['a', 'b']), 'b');
assert.throws(() => asked.option('m', 1), /m=2.5: expected a whole number/);
assert.equal(asked.option('other', ['c', 'd']), 'c');
assert.throws(() => asked.requireKnownOptions(), /unknown option fast: expected n=NUMBER .* or rule=a\|b/);
assert.throws(() => sceneOf({ x, options: ['rule=e'] }).option('rule', ['a', 'b']), /rule=e: expected a or b/);

// moving pins and obstacles
const led = sceneOf({ x, pinned: [1, 0, 0], pins: { particles: [0], home: [[0, 0, 0]], motion } });
assert.deepEqual(led.pinsAt(2)[0].x, motionAt(motion, 2).displacement);
const plane = { point: [0, 1, 0], normal: [0, 1, 0], velocity: [0, 2, 0] };
assert.deepEqual(led.obstacleAt(plane, 3, 0.5), [0, 7.5, 0]);
assert.deepEqual(led.obstacleAt({ centre: [1, 1, 1] }, 3), [1, 1, 1]);

// drag as a single number
assert.throws(() => sceneOf({ x, terms: [{ type: 'drag', coefficient: [1, 1, 1] }] }).oneDamping('differs'), /differs/);
assert.equal(sceneOf({ x, terms: [{ type: 'drag', coefficient: [2, 4, 6] }] }).oneDamping('differs'), 2);
