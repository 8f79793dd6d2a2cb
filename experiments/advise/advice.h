// Advice: the cheapest model, method and step that meet a tolerance on a scene, found by measured search.
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

/// No trial meets the tolerance, or no reference can show that one does. what() is the reason, one line.
struct CannotGuarantee : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// One run of the search.
struct Trial {
  std::string model;  // "full", or "without ..."
  std::string method;
  double step;                  // s, as used; the mean of adaptive methods
  double relative;              // relative tolerance of adaptive methods; 0 elsewhere
  std::optional<double> error;  // m, largest RMS distance from the truth in the window; none: failed
  Outcome outcome;
  long springs;
  std::optional<double> limit;  // s, the largest stable step that theory predicts; empty where none does
  bool accidental = false;      // within the tolerance, but a shorter step of the same method and model is not
  bool meets = false;           // error + error bar of the truth within the tolerance, over a whole run that held
  /// Force evaluations times springs.
  double cost() const { return static_cast<double>(outcome.evaluations) * static_cast<double>(springs); }
};

struct Advice {
  Scene scene;       // as given
  double tolerance;  // m
  Tier tier;
  std::string truth;                   // description of its origin
  double error_bar;                    // m, the truth's, in the window
  bool under_contact_rule;             // the tolerance bounds a difference, no error
  double until;                        // s, the guarantee ends here
  std::vector<Trial> trials = {};      // everything tried, in order
  size_t chosen = 0;                   // index of a trial
  std::vector<size_t> tied = {};       // other methods that meet it at the same cost, less accurate
  std::optional<size_t> second = {};   // the cheapest other method that meets it
  std::optional<size_t> of_full = {};  // the choice for the whole scene, where a lesser model is cheaper
  StepBound bound = StepBound::none;   // reason why the step is not longer
  bool between_samples = false;        // the errors at the samples alone would have misled
  std::vector<std::string> left_out = {};
  std::string toml = {};                // a scene file that runs as advised
  double checked = 0;                   // m, the error of that file's own run
  std::vector<WishResult> wishes = {};  // and their values in that run
  std::vector<std::string> caveats = {};
};

/// Searches the whole scene and the least model whose own error is half the tolerance at most (StepSearch), and takes
/// the run that recommend() chooses: with the whole scene and 1 % of its motion, the one that a report recommends. The
/// errors of the search are those at the samples, as in a report. The chosen run's file is then run once more with its
/// error looked for after every step (dense_truth.h); where that breaks the tolerance, all is searched again with such
/// errors. Throws CannotGuarantee where no truth is known, its bar is above a third of the tolerance, the tolerance is
/// above the scene's motion, or no method meets it.
Advice advise(const Scene& scene, double tolerance, std::vector<Method> methods);

}  // namespace crosscheck
