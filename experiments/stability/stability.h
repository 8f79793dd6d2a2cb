// Measures the largest stable step of one method on one scene as a row, and explains deviations from the prediction.
#pragma once

#include "experiments/experiment.h"
#include "experiments/stability/limit.h"

namespace crosscheck {

/// Reason for which a run may differ from theory, which describes small motion about one state.
inline std::string deviation_reason(const BaseState& base, const Method& method) {
  const Model& model = base.scene.model;
  std::vector<std::string> reasons;
  if (has_contact(model)) reasons.emplace_back("contact");
  if (model.particles.move) reasons.emplace_back("moved pins");
  if (!base.at_rest && model.find<Springs>()) reasons.emplace_back("the motion stretches and turns the springs");
  if (model.find<Aerodynamics>()) reasons.emplace_back("the air damps as well");
  if (!method.family().departure.empty()) reasons.emplace_back(method.family().departure);
  if (reasons.empty()) reasons.emplace_back(model.find<Springs>() ? "nonlinearity of the springs" : "unknown reason");
  std::string all;
  for (const std::string& reason : reasons) all += (all.empty() ? "" : "; ") + reason;
  return all;
}

inline std::string saddle_note(const BaseState& base) {
  if (!base.saddle) return "";
  return base.at_rest
             ? "the equilibrium with the symmetry of the start is an unstable saddle; this is the stable one next to it"
             : "the only equilibrium found is an unstable saddle";
}

/// Reason for which the measurement differs from theory, or is not predicted; empty if they agree.
inline std::string reason_for(const BaseState& base, const Method& method, const PredictedLimit& p,
                              const MeasuredLimit& m) {
  // the result of a bisection is no more precise than the width of its bracket
  const double enough = std::max(0.01, m.precision());
  switch (m.kind) {
    case MeasuredLimit::found:
      if (!p.missing.empty()) return p.missing;
      return std::abs(m.limit() / p.limit - 1) <= enough ? "" : deviation_reason(base, method);
    case MeasuredLimit::no_step:
      if (!p.missing.empty()) return p.missing;
      return p.limit == 0 ? "" : deviation_reason(base, method);
    case MeasuredLimit::every_step:
      if (!p.missing.empty()) return p.missing;
      return std::isfinite(p.limit) ? deviation_reason(base, method) : "";
    default:
      return "";
  }
}

struct Effort {
  long steps;        // per run
  double precision;  // relative width of the bracket at which the bisection ends
};
/// Quick runs: fine on small scenes, coarse if each step solves an equation. Full runs: as fine as 0.5 s of CPU time
/// permits.
Effort effort_for(const Method& method, const Scene& scene, bool full);

/// Small scenes cost so little that every method is measured on them, with high precision.
inline bool is_small(const Scene& scene) { return scene.start.x.cols() <= 50; }

/// Adds a row of table stability and, if a step multiplies modes by a factor, rows of stability-growth.
void add_limit(const Scene& scene, const Method& method, const Effort& effort, TableSet& tables);

/// A step at which runs fail within several steps, but not within one.
inline double failing_step(double limit) { return 1.75 * limit; }

/// Adds rows of stability-failure: the last steps of a run at failing_step() from the scene's own start, four of which
/// are shown in pictures, and for comparison a run that holds. Adds nothing if the run does not fail within 400 steps.
void add_failure(const Scene& scene, const Method& method, double limit, std::optional<double> growth,
                 TableSet& tables);

/// True if the method's maps are drawn by default. These are the methods of peers and, for each way of failing, the
/// first rule of mysim that fails in that way.
bool is_mapped(const Method& method);

}  // namespace crosscheck
