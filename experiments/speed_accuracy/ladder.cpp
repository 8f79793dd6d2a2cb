// Ladders of steps and tolerances.
#include "experiments/speed_accuracy/ladder.h"

#include <cmath>

#include "mysim/frequency.h"

namespace crosscheck {
namespace {

/// Whether the method's rule is known to fail at long steps.
bool limited(const Method& method) {
  for (const Stepper& rule : steppers())
    if (rule.name == method.rule || method.stepper == &rule) return std::isfinite(rule.limit(1, 0.1));
  return false;
}

/// Rough CPU time of one evaluation, s.
double seconds_of_evaluation(const Method& method, const Scene& scene) {
  const auto* springs = scene.model.find<Springs>();
  const double elements =
      static_cast<double>(scene.start.x.cols()) + (springs ? static_cast<double>(springs->list.size()) : 0);
  if (method.stepper) return 100e-9 + 5e-9 * elements;
  if (!method.name.starts_with("bullet")) return 200e-9 + 12e-9 * elements;  // forces written apart, plainly
  return 2e-6 + 40e-9 * elements;
}

}  // namespace

Run Setting::applied_to(Run run) const {
  (tolerance ? run.tolerance : run.step) = value;
  return run;
}

double estimated_seconds(const Method& method, const Scene& scene, const Run& run, const Setting& setting) {
  const Run asked = setting.applied_to(run);
  double evaluations = 1;  // per step
  // implicit rules: conjugate gradients take more products with the matrix at longer steps (measured on cloth-hang)
  const double longer = std::sqrt(asked.step / scene.step);
  for (const Stepper& rule : steppers())
    if (rule.name == method.rule) evaluations = rule.evaluations > 0 ? rule.evaluations : 60 * longer;
  if (method.name.starts_with("bullet/deformable-implicit")) evaluations = 10 * longer;
  if (method.adaptive) evaluations = 7;
  return evaluations * run.duration / plan(asked).h * seconds_of_evaluation(method, scene);
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
    if (estimated_seconds(method, scene, run, setting) > most) {
      if (dropped) ++*dropped;
      continue;
    }
    settings.push_back(setting);
  }
  return settings;
}

}  // namespace crosscheck
