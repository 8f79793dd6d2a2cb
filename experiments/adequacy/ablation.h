// Ablations of a scene's model: ingredients are left out singly, and cumulatively.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/scenes/ingredients.h"
#include "reference/method.h"
#include "reference/truth/truth.h"

namespace crosscheck {

/// The reference for model errors: the truth of the full scene, with a rule and a step for which the error of the full
/// model is at most a fifth of the tolerance.
struct ReferenceSolution {
  Method method;
  Run run;       // up to the end of the window
  Truth truth;   // its samples extend at least as far
  double floor;  // m, the error of the full model with this rule and step
};
/// Throws Unsupported with the reason if no truth is known or no step is fine enough.
ReferenceSolution reference_solution_of(const Scene& scene, double tolerance);

struct AblatedModel {
  std::string name;              // "full", "without bend springs", "without bend springs, drag"
  std::vector<std::string> out;  // ingredients left out
  bool single;                   // one ingredient alone; otherwise a stage of the cumulative ablation
  Scene scene;
  std::optional<double> error;  // m, largest RMS distance from the truth of the full scene; empty if the run failed
  Outcome outcome;
  /// Force evaluations times springs, which is reproducible, unlike CPU time.
  double cost() const {
    return static_cast<double>(outcome.evaluations) * static_cast<double>(springs_of(scene.model));
  }
};

/// The full model, every single removal, and the cumulative ablation, each stage of which removes the ingredient that
/// adds the least error. It ends with the first stage whose error exceeds `most` (m), or when nothing is left to
/// remove.
std::vector<AblatedModel> ablations_of(const Scene& scene, const ReferenceSolution& reference, double most);

/// The model that leaves out the most ingredients within the tolerance (m); the full model if nothing can be left out.
const AblatedModel& least_model(const std::vector<AblatedModel>& models, double tolerance);

/// Error of a model of the scene, m: its distance from `truth` over time, with the rule of the reference solution.
/// Empty if the run failed.
std::optional<double> model_error(const Scene& model, const ReferenceSolution& reference, const Trajectory& truth,
                                  Outcome& outcome);

/// A different start of the scene. Every free particle gets a smooth velocity field of RMS `speed` (m/s): a wave as
/// long as the scene, in a seeded direction and phase, that vanishes at the pins. In first-order scenes, positions move
/// by a tenth of their distance from the origin.
Scene unseen_start(const Scene& scene, double speed, unsigned seed);

}  // namespace crosscheck
