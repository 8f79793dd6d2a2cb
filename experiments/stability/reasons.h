// Why a measured limit is not the predicted one.
#pragma once

#include "experiments/stability/trial.h"

namespace crosscheck {

/// Why theory, which looks at small motion about one state, may say something else than the run.
inline std::string why_apart(const Subject& subject, const Method& method) {
  const Model& model = subject.scene.model;
  std::vector<std::string> reasons;
  if (model.find<Spheres>()) reasons.emplace_back("contact");
  if (model.particles.move) reasons.emplace_back("moved pins");
  if (!subject.at_rest && model.find<Springs>())
    reasons.emplace_back("the motion stretches and turns the springs of the start");
  if (model.find<Aerodynamics>()) reasons.emplace_back("air damps too");
  if (method.name.starts_with("bullet"))
    reasons.emplace_back("Bullet clamps speeds to the body's diagonal over the step");
  if (reasons.empty())
    reasons.emplace_back(model.find<Springs>() ? "nonlinearity of the springs" : "for no reason that is known");
  std::string all;
  for (const std::string& reason : reasons) all += (all.empty() ? "" : "; ") + reason;
  return all;
}

/// What a saddle means for the row; empty where there was none.
inline std::string word_on_saddle(const Subject& subject) {
  if (!subject.saddle) return "";
  return subject.at_rest
             ? "the equilibrium in the symmetry of the start is a saddle, not a rest; this is the rest beside it"
             : "the only equilibrium found is a saddle, not a rest";
}

/// Why the measurement is not what theory says, or why theory says nothing; empty where they agree.
inline std::string reason_for(const Subject& subject, const Method& method, const Prediction& p, const Measured& m) {
  // a bracket tells no more than its width
  const double enough = std::max(0.01, m.precision());
  switch (m.kind) {
    case Measured::found:
      if (!p.missing.empty()) return p.missing;
      return std::abs(m.limit() / p.limit - 1) <= enough ? "" : why_apart(subject, method);
    case Measured::no_step:
      if (!p.missing.empty()) return p.missing;
      return p.limit == 0 ? "" : why_apart(subject, method);
    case Measured::every_step:
      if (!p.missing.empty()) return p.missing;
      return std::isfinite(p.limit) ? why_apart(subject, method) : "";
    default:
      return "";
  }
}

}  // namespace crosscheck
