// Nanoseconds per element.
#include "experiments/estimate.h"

#include <cmath>

#include "experiments/adequacy/grids.h"

namespace crosscheck {
namespace {

/// One evaluation, s.
double seconds_of_evaluation(const Method& method, const Scene& scene) {
  const auto* springs = scene.model.find<Springs>();
  const double elements =
      static_cast<double>(scene.start.x.cols()) + (springs ? static_cast<double>(springs->list.size()) : 0);
  if (method.stepper) return 100e-9 + 5e-9 * elements;
  if (!method.name.starts_with("bullet")) return 200e-9 + 12e-9 * elements;  // forces written apart, plainly
  return 2e-6 + 40e-9 * elements;
}

}  // namespace

double estimated_seconds(const Method& method, const Scene& scene, const Run& run) {
  double evaluations = 1;  // per step
  // conjugate gradients, measured on cloth-hang at steps of 0.5 to 17 ms: mysim's, with the multigrid that sheets have,
  // and Bullet's; mysim's without it on jelly at 1 to 7 ms
  const double longer = plan(run).h / scene.step;
  if (const Stepper* rule = rule_of(method))
    evaluations = rule->evaluations > 0 ? rule->evaluations
                  : sheet_of(scene)     ? 20 * std::pow(longer, 0.3)
                                        : 60 * std::sqrt(longer);
  if (method.name.starts_with("bullet/deformable-implicit")) evaluations = 2.5 * std::pow(longer, 0.8);
  if (method.adaptive) evaluations = 7;
  return evaluations * run.duration / plan(run).h * seconds_of_evaluation(method, scene);
}

double estimated_as_it_begins(const Method& method, const Scene& scene, Run run) {
  const double part = 1. / run.samples;
  run.duration *= part, run.samples = 1;
  const auto evaluations = static_cast<double>(run_method(method, scene, run, {}).evaluations);
  return evaluations / part * seconds_of_evaluation(method, scene);
}

double estimated_seconds(const Method& method, const Scene& scene, long steps) {
  return estimated_seconds(method, scene, {scene.step, scene.step * static_cast<double>(steps), 1});
}

}  // namespace crosscheck
