#!/usr/bin/env node
// An engine on crosscheck_engine.mjs without packages: symplectic Euler with the module's forces. Option fail=N ends a
// run with a verdict after N steps.
import { failed, serve } from '../../../reference/protocol/crosscheck_engine.mjs';

const description = { engine: 'module engine 1.0', laws: ['hooke', 'bullet-link'],
                      terms: ['springs', 'dashpots', 'bending', 'gravity', 'drag', 'wind'] };

serve(description, (scene) => {
  const { h, mass, drag, gravity } = scene, x = scene.x.slice(), v = scene.v.slice(), f = new Float64Array(x.length);
  const last = scene.option('fail', 1000000);
  let coincident_springs = 0, steps = 0;
  console.log('stdout is not the engine\'s in serve mode');
  return {
    step(t, next) {
      if (++steps > last) failed('solver', 'option fail');
      f.fill(0);
      coincident_springs += scene.addSpringForces(x, f);
      scene.addDashpotForces(x, v, f);
      scene.addBendingForces(x, f);
      scene.addWindForces(t, f);
      for (let i = 0; i < x.length; ++i) {
        const p = (i / 3) | 0;
        v[i] += h * (gravity[i % 3] + (f[i] - drag[p] * v[i]) / mass[p]);
        x[i] += h * v[i];
      }
      scene.placePins(next, x, v);
    },
    read: (frame, speeds) => (frame.set(x), speeds.set(v)),
    report: () => ({ coincident_springs, readback: {
      precision: 'double', mass, pinned: scene.pinned, may_sleep: false, gravity, drag: scene.damping, spheres: [],
      links: scene.linksRead((_, { rest_length, stiffness }) => ({ rest_length, stiffness })), probe: scene.ownProbe() } }),
  };
});
