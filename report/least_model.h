// How little of a scene's model is enough, from table `adequacy-least`: shared by findings and the table of scenes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/experiment.h"

namespace crosscheck {

/// The least model that was found within one tolerance.
struct LeastModel {
  std::string tolerance;  // "the scene's own", "1 % of its motion", "10 % of its motion"
  std::string left_out;   // "shear springs, bend springs"; empty: nothing
  bool holds;             // from starts that the search had not seen, too
  int failing, starts;    // of these starts, how many are beyond the tolerance, of how many
  double cost;            // of the full model's
  bool of_motion(int percent) const { return tolerance.starts_with(std::to_string(percent) + " %"); }
};
/// From the strictest tolerance of the table on, in its order; empty where the scene was not asked.
std::vector<LeastModel> least_models_of(const Rows& rows, const std::string& scene);

/// What stays of the scene's ingredients (table `adequacy`) when those are left out.
std::vector<std::string> kept_without(const Rows& rows, const std::string& scene, const std::string& left_out);

}  // namespace crosscheck
