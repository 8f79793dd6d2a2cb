// The largest stable step of one method on one scene, as a row, and why it is not the predicted one.
#pragma once

#include "experiments/experiment.h"
#include "experiments/stability/limit.h"

namespace crosscheck {

// Reasons why a measured limit is not the predicted one.

/// The reason why theory, of small motion about one state, may differ from the run.
inline std::string deviation_reason(const BaseState& base, const Method& method) {
  const Model& model = base.scene.model;
  std::vector<std::string> reasons;
  if (has_contact(model)) reasons.emplace_back("contact");
  if (model.particles.move) reasons.emplace_back("moved pins");
  if (!base.at_rest && model.find<Springs>())
    reasons.emplace_back("the motion stretches and turns the springs of the start");
  if (model.find<Aerodynamics>()) reasons.emplace_back("air damps too");
  if (!method.family().departure.empty()) reasons.emplace_back(method.family().departure);
  if (reasons.empty())
    reasons.emplace_back(model.find<Springs>() ? "nonlinearity of the springs" : "for no reason that is known");
  std::string all;
  for (const std::string& reason : reasons) all += (all.empty() ? "" : "; ") + reason;
  return all;
}

/// A note on a saddle for the row; empty where there was none.
inline std::string saddle_note(const BaseState& base) {
  if (!base.saddle) return "";
  return base.at_rest
             ? "the equilibrium in the symmetry of the start is a saddle, not a rest; this is the rest beside it"
             : "the only equilibrium found is a saddle, not a rest";
}

/// The reason why the measurement differs from theory, or why theory says nothing; empty where they agree.
inline std::string reason_for(const BaseState& base, const Method& method, const PredictedLimit& p,
                              const MeasuredLimit& m) {
  // a bracket is no more exact than its width
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

/// The effort of a search.
struct Effort {
  long steps;        // of each run
  double precision;  // at which halving ends
};
/// Quick: fine on small scenes, coarse where each step solves an equation. Full: as fine as about 5 s of CPU time pay
/// for.
Effort effort_for(const Method& method, const Scene& scene, bool full);

/// Small scenes cost so little that every method is measured on them, and finely.
inline bool is_small(const Scene& scene) { return scene.start.x.cols() <= 50; }

/// A row of table stability, and rows of stability-growth where steps multiply modes.
void add_limit(const Scene& scene, const Method& method, const Effort& effort, TableSet& tables);

/// A step at which runs fail within some steps, and not in one.
inline double failing_step(double limit) { return 1.75 * limit; }

/// Rows of stability-failure: the last steps of a run at that step from the scene's own start, which four of them are
/// to be seen in pictures, and a run that holds beside it. None where it does not fail within some hundred steps.
void add_failure(const Scene& scene, const Method& method, double limit, std::optional<double> growth,
                 TableSet& tables);

/// Whether the method's maps are drawn unasked: those of the peers, and of the subject's first rule of each kind that
/// breaks in its own way.
bool is_mapped(const Method& method);

}  // namespace crosscheck
