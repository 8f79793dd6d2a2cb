// Ladders of steps and tolerances, and what is timed of their runs.
#include "experiments/speed_accuracy/ladder.h"

#include <cmath>
#include <limits>

#include "experiments/estimate.h"
#include "mysim/frequency.h"

namespace crosscheck {
namespace {

/// The longest step at which the method's rule holds by theory when the scene begins, s; infinite where none is known.
double limit_of(const Method& method, const Scene& scene) {
  const Stepper* rule = rule_of(method);
  if (!rule || !std::isfinite(rule->limit(1, 0.1)) || scene.model.first_order())
    return std::numeric_limits<double>::infinity();
  const double omega = fastest_frequency(scene.model, scene.start);
  return omega > 0 ? rule->limit(omega, uniform_drag_rate(scene.model).value_or(0))
                   : std::numeric_limits<double>::infinity();
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
  const double limit = limit_of(method, scene);
  for (int halving = 6; halving >= -4; --halving) {
    const Setting setting{false, plan({run.step * std::pow(2, halving), run.duration, run.samples}).h};
    // one or two that fail show where the others end
    if (setting.value == last || (halving > 3 && setting.value > 2 * limit)) continue;
    last = setting.value;
    const double most = (halving >= 0 ? 1.8 : 0.35) * (full ? 1 : 0.7);  // s
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
