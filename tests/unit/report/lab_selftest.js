// Runs scenes with steppers of the lab's engine, in Node or a browser. `runs` contains {scene, stepper, steps, exact,
// duration}. Returns each run's fingerprint and time, and final positions of runs that are not exact.
async function runAll(runs) {
  const lab = await labModule(), scenes = labScenes(), seen = [];
  for (const {scene, stepper, steps, exact, duration} of runs) {
    const sim = lab.open(scenes[scene]), entry = {scene, stepper};
    try {
      sim.start({stepper, tolerance: 1e-6, duration, observe: false});
      sim.call('advance', Infinity, steps);
      Object.assign(entry, {t: sim.t, fingerprint: sim.fingerprint(), places: exact ? [] : [...sim.positions]});
    } catch (problem) {
      entry.refused = problem.message;
    }
    seen.push(entry);
    sim.close();
  }
  return seen;
}
