// Ablations of a scene's model: ingredients are left out singly and cumulatively.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/scenes/ingredients.h"
#include "reference/method.h"
#include "reference/truth/truth.h"

namespace crosscheck {

/// The reference solution of the full scene, and a method and step with an error of at most a fifth of the tolerance.
struct ReferenceSolution {
  Method method;
  Run run;       // up to the end of the window
  Truth truth;   // samples extend at least to the end of `run`
  double floor;  // m, error of the full model with this method and step
};
/// Throws Unsupported if no truth is known or no step is fine enough.
ReferenceSolution reference_solution_of(const Scene& scene, double tolerance);

struct AblatedModel {
  std::string name;              // "full", "without bend springs", "without bend springs, drag"
  std::vector<std::string> out;  // ingredients left out
  bool single;                   // true: one ingredient is removed alone; false: a stage of the cumulative ablation
  Scene scene;
  std::optional<double> error;  // m, largest RMS distance from the truth of the full scene; empty if the run failed
  Outcome outcome;
  /// Force evaluations times the number of springs: reproducible, unlike CPU time.
  double cost() const {
    return static_cast<double>(outcome.evaluations) * static_cast<double>(springs_of(scene.model));
  }
};

/// The full model, every single removal, and the cumulative ablation. Each stage of the cumulative ablation removes the
/// ingredient that adds the least error, until the error exceeds `most` (m) or nothing is left to remove.
std::vector<AblatedModel> ablations_of(const Scene& scene, const ReferenceSolution& reference, double most);

/// The model with the fewest ingredients whose error is within the tolerance (m).
const AblatedModel& least_model(const std::vector<AblatedModel>& models, double tolerance);

/// Largest RMS distance (m) of the run of a model from `truth`. Empty if the run failed. Sets `outcome`.
std::optional<double> model_error(const Scene& model, const ReferenceSolution& reference, const Trajectory& truth,
                                  Outcome& outcome);

/// The scene with a different start. The free particles get a velocity field of RMS `speed` (m/s): a wave as long as
/// the scene, which vanishes at the pins, and whose direction and phase depend on `seed`. In first-order scenes,
/// positions change instead, by a tenth of their distance from the origin.
Scene unseen_start(const Scene& scene, double speed, unsigned seed);

}  // namespace crosscheck
