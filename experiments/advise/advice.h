// Advice: the cheapest model, method and step that meet a tolerance on a scene, found by measured trials.
#pragma once

#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "experiments/advise/dense_truth.h"
#include "experiments/advise/fit.h"
#include "experiments/scenes/ingredients.h"
#include "experiments/speed_accuracy/step_search.h"
#include "reference/method.h"
#include "reference/truth/truth.h"

namespace crosscheck {

/// Thrown if no trial meets the tolerance, or if no reference solution is accurate enough to check the trials. what():
/// the reason in one line.
struct CannotGuarantee : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct Trial {
  std::string model;  // "full", or "without ..."
  std::string method;
  double step;                  // s, as used by the run; the mean for adaptive methods
  double relative;              // relative tolerance of adaptive methods, 0 for all others
  std::optional<double> error;  // m, largest RMS distance from the truth in the window; empty if the run failed
  Outcome outcome;
  long springs;
  std::optional<double> limit;  // s, largest stable step by theory; empty if theory gives none
  bool accidental = false;      // within the tolerance, although a shorter step of the same method and model is not
  bool meets = false;           // error + error bar of the truth are within the tolerance, and the run completed
  double cost() const { return static_cast<double>(outcome.evaluations) * static_cast<double>(springs); }
};

struct Advice {
  Scene scene;       // as given
  double tolerance;  // m
  Tier tier;
  std::string truth;                   // description of its origin
  double error_bar;                    // m, of the truth within the window
  bool under_contact_rule;             // true if the tolerance bounds a difference between methods, not an error
  double until;                        // s, end of the guarantee
  std::vector<Trial> trials = {};      // in the order of the search
  size_t chosen = 0;                   // index of a trial
  std::vector<size_t> tied = {};       // other methods that meet the tolerance at the same cost, but less accurately
  std::optional<size_t> second = {};   // index of the cheapest other method that meets the tolerance
  std::optional<size_t> of_full = {};  // index of the best trial of the full scene, if a smaller model is cheaper
  StepBound bound = StepBound::none;   // reason why the step is not longer
  bool between_samples = false;        // true if the error between samples exceeded the tolerance
  std::vector<std::string> left_out = {};
  std::string toml = {};                // scene file that runs as advised
  double checked = 0;                   // m, error of a run of that file
  std::vector<WishResult> wishes = {};  // the scene's wishes, with the values reached in that run
  std::vector<std::string> caveats = {};
};

/// Searches the full scene, and the smallest model whose own error is at most half the tolerance (StepSearch). Chooses
/// with recommend(), as the report does. The search uses the errors at the samples. If the chosen run's error exceeds
/// the tolerance between samples, the search is repeated with errors observed after every step (dense_truth.h). Throws
/// CannotGuarantee if no truth is known, its error bar exceeds a third of the tolerance, the tolerance exceeds the
/// scene's motion, or no method meets the tolerance.
Advice advise(const Scene& scene, double tolerance, std::vector<Method> methods);

}  // namespace crosscheck
