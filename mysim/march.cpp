// Samples, steps, observers; the clock runs while the world steps.
#include "mysim/march.h"

#include <fmt/format.h>

#include "mysim/clock.h"
#include "mysim/errors.h"
#include "mysim/observers/pairs.h"

namespace crosscheck {

Outcome march(World& world, const Run& run, Observer& observer) {
  const StepPlan steps = plan(run);
  const bool every_step = observer.every_step();
  auto* pairs = steps.steps_per_sample < 2 ? nullptr : dynamic_cast<PairsObserver*>(&observer);
  // how many steps before a sample, modulo the distance of pairs
  const auto left = [&](int step) { return (steps.steps_per_sample - step) % PairsObserver::steps_between_pairs; };
  CpuClock clock(run.timed);
  Outcome out;
  out.step = steps.h;
  out.verdict = observer.observe(world.state(0), true);

  for (int sample = 0; sample < steps.samples && out.verdict == Verdict::ok; ++sample) {
    if (pairs && !pairs->closely() && left(0) == 2) pairs->earlier(world.state(steps.time(sample, 0)));
    clock.start();
    for (int step = 1; step <= steps.steps_per_sample && out.verdict == Verdict::ok; ++step) {
      const double t = steps.time(sample, step);
      try {
        world.step(steps.time(sample, step - 1), t);
      } catch (const SolverFailure& failure) {
        out.verdict = Verdict::solver;
        out.reason = failure.what();
        break;
      }
      out.end = t;
      const bool first = out.steps++ == 0, sampled = step == steps.steps_per_sample;
      const bool between = pairs && !sampled, closely = between && pairs->closely(),
                 earlier = between && !closely && left(step) == 2,
                 later = closely || (between && step >= 2 && left(step) == 0);
      if (!every_step && !sampled && !first && !earlier && !later) continue;

      clock.stop();
      if (first && (out.readback = world.read_back())) out.readback->step = steps.h;
      if (every_step) world.tell_contact(observer);
      if (every_step || sampled) out.verdict = observer.observe(world.state(t), sampled);
      if (earlier) pairs->earlier(world.state(t));
      if (later && out.verdict == Verdict::ok) out.verdict = pairs->later(world.state(t));
      clock.start();
    }
    clock.stop();
  }

  out.cpu_seconds = clock.seconds();
  if (out.verdict != Verdict::ok)
    out.reason = fmt::format("the run failed at t = {:.4g} s{}{}", out.end, out.reason.empty() ? "" : ": ", out.reason);
  return out;
}

}  // namespace crosscheck
