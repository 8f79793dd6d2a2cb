// Runs a Bullet world under the same plan and the same observers as mysim.
#include "reference/bullet/drive.h"

#include <fmt/format.h>

#include "mysim/clock.h"

namespace crosscheck::bullet {

Outcome drive(World& world, const Scene& scene, const Run& run, Observer& observer) {
  const StepPlan steps = plan(run);
  const bool every_step = observer.every_step();
  State s = scene.start;
  CpuClock clock;
  Outcome out;
  out.step = steps.h;
  out.verdict = observer.observe(s, true);

  for (int sample = 0; sample < steps.samples && out.verdict == Verdict::ok; ++sample) {
    clock.start();
    for (int step = 1; step <= steps.steps_per_sample && out.verdict == Verdict::ok; ++step) {
      const double t = steps.time(sample, step);
      world.step(steps.time(sample, step - 1), t);
      ++out.steps;
      const bool sampled = step == steps.steps_per_sample;
      if (every_step || sampled || !out.readback) {
        clock.stop();
        if (!out.readback) {
          out.readback = world.read_back();
          out.readback->step = steps.h;
        }
        if (every_step || sampled) {
          world.read_state(t, s);
          out.verdict = observer.observe(s, sampled);
        }
        clock.start();
      }
    }
    clock.stop();
  }

  out.end = s.t;
  out.cpu_seconds = clock.seconds();
  out.evaluations = out.steps;
  if (out.verdict != Verdict::ok) out.reason = fmt::format("the run failed at t = {:.4g} s", out.end);
  return out;
}

}  // namespace crosscheck::bullet
