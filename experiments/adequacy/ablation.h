// Ablations of a scene's model: ingredients are left out one at a time, and one after the other.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/scenes/ingredients.h"
#include "reference/method.h"
#include "reference/truth/truth.h"

namespace crosscheck {

/// The reference for errors of models: the truth of the full scene, and a rule and step so fine that on the full
/// model its own error is a fifth of the tolerance at most.
struct ReferenceSolution {
  Method method;
  Run run;       // up to the end of the window
  Truth truth;   // its samples go at least as far
  double floor;  // m, the error of the full model by this rule and step
};
/// Throws Unsupported with the reason where there is none: no truth is known, or no step is fine enough.
ReferenceSolution reference_solution_of(const Scene& scene, double tolerance);

struct AblatedModel {
  std::string name;              // "full", "without bend springs", "without bend springs, drag"
  std::vector<std::string> out;  // ingredients left out
  bool single;                   // one ingredient alone; else a step of the cumulative ablation
  Scene scene;
  std::optional<double> error;  // m, largest RMS distance from the truth of the full scene; empty where it failed
  Outcome outcome;
  /// Force evaluations times springs: the same in each run, unlike CPU time.
  double cost() const {
    return static_cast<double>(outcome.evaluations) * static_cast<double>(springs_of(scene.model));
  }
};

/// The full model, every single removal, and the cumulative ablation: at each step the ingredient goes that adds the
/// least error. It ends where the next step errs by more than `most` (m), that step included, or nothing is left.
std::vector<AblatedModel> ablations_of(const Scene& scene, const ReferenceSolution& reference, double most);

/// The ablated model that leaves out the most within the tolerance (m); the full model where nothing can be left out.
const AblatedModel& least_model(const std::vector<AblatedModel>& models, double tolerance);

/// The error of a model of the scene, m: its distance from `truth` over time by the reference solution's rule; empty
/// where the run failed.
std::optional<double> model_error(const Scene& model, const ReferenceSolution& reference, const Trajectory& truth,
                                  Outcome& outcome);

/// Another start of the scene: every free particle gets a smooth velocity field (a wave as long as the scene, in a
/// seeded direction and phase, that vanishes at the pins) of RMS `speed` (m/s); in first-order scenes its place moves
/// by a tenth of its distance from the origin.
Scene unseen_start(const Scene& scene, double speed, unsigned seed);

}  // namespace crosscheck
