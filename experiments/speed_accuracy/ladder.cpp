// Ladders of steps and tolerances, and what is timed of their runs.
#include "experiments/speed_accuracy/ladder.h"

#include <cmath>

#include "experiments/estimate.h"

namespace crosscheck {
namespace {

/// Whether the method's rule is known to fail at long steps.
bool limited(const Method& method) {
  const Stepper* rule = rule_of(method);
  return rule && std::isfinite(rule->limit(1, 0.1));
}

}  // namespace

Run Setting::applied_to(Run run) const {
  (tolerance ? run.tolerance : run.step) = value;
  return run;
}

std::vector<Setting> ladder(const Method& method, const Scene& scene, const Run& run, bool full, int* dropped) {
  std::vector<Setting> settings;
  if (method.adaptive) {
    for (double tolerance = 1e-2; tolerance > (full ? 5e-11 : 5e-9); tolerance /= 100)
      settings.push_back({true, tolerance});
    return settings;
  }
  double last = 0;
  for (int halving = limited(method) ? 3 : 6; halving >= -4; --halving) {
    const Setting setting{false, plan({run.step * std::pow(2, halving), run.duration, run.samples}).h};
    if (setting.value == last) continue;
    last = setting.value;
    const double most = (halving >= 0 ? 1.2 : 0.35) * (full ? 1 : 0.7);  // s
    if (estimated_seconds(method, scene, setting.applied_to(run)) > most) {
      if (dropped) ++*dropped;
      continue;
    }
    settings.push_back(setting);
  }
  return settings;
}

TimedPart part_of(const Method& method, const Scene& scene, const Run& base, const Setting& setting) {
  Run run = setting.applied_to(base);
  if (!method.fingerprint.empty()) return {run};     // a program of its own: what its start costs is not known
  const bool touches = scene.model.find<Spheres>();  // that may cost more than falling
  if (method.adaptive && touches) return {run};
  const double enough = 0.02;  // s: a hundred thousand ticks of the clock
  const double all_of_it =
      method.adaptive ? estimated_as_it_begins(method, scene, run) : estimated_seconds(method, scene, run);
  const double share = std::min(1., enough / all_of_it);
  const bool whole = share > 0.7 || touches;
  if (method.adaptive) {
    if (whole) return {run};
    run.samples = std::max(1, static_cast<int>(std::ceil(share * run.samples)));
    run.duration = base.duration * run.samples / base.samples;
    return {run, static_cast<double>(run.samples) / base.samples};
  }
  // the clock is read at each sample, which takes 0.3 microseconds: one in 100 is often enough to tell a blow-up
  const long all = static_cast<long>(plan(run).steps_per_sample) * run.samples;
  long steps = whole ? all : std::min(all, std::max(20L, std::lround(share * static_cast<double>(all))));
  const int samples =
      std::clamp(static_cast<int>(share * all_of_it / 1e-4), 1, static_cast<int>(std::min(200L, steps)));
  steps = steps / samples * samples;
  return {{plan(run).h, plan(run).h * static_cast<double>(steps), samples},
          static_cast<double>(steps) / static_cast<double>(all)};
}

}  // namespace crosscheck
