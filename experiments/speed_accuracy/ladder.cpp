// Ladders of steps and tolerances.
#include "experiments/speed_accuracy/ladder.h"

#include <cmath>

#include "experiments/estimate.h"
#include "mysim/frequency.h"

namespace crosscheck {
namespace {

/// Whether the method's rule is known to fail at long steps.
bool limited(const Method& method) {
  for (const Stepper& rule : steppers())
    if (rule.name == method.rule || method.stepper == &rule) return std::isfinite(rule.limit(1, 0.1));
  return false;
}

}  // namespace

Run Setting::applied_to(Run run) const {
  (tolerance ? run.tolerance : run.step) = value;
  return run;
}

std::vector<Setting> ladder(const Method& method, const Scene& scene, const Run& run, bool full, int* dropped) {
  std::vector<Setting> settings;
  if (method.adaptive) {
    for (double tolerance = 1e-2; tolerance > (full ? 5e-11 : 5e-9); tolerance /= full ? 10 : 100)
      settings.push_back({true, tolerance});
    return settings;
  }
  double last = 0;
  for (int halving = limited(method) ? 3 : 6; halving >= -4; --halving) {
    const Setting setting{false, plan({run.step * std::pow(2, halving), run.duration, run.samples}).h};
    if (setting.value == last) continue;
    last = setting.value;
    const double most = full ? 1.5 : halving >= 0 ? 1.2 : 0.35;
    if (estimated_seconds(method, scene, setting.applied_to(run)) > most) {
      if (dropped) ++*dropped;
      continue;
    }
    settings.push_back(setting);
  }
  return settings;
}

}  // namespace crosscheck
