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
  std::optional<double> error;  // m, largest RMS distance from the truth in the window, after any step; none: failed
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
  std::string truth;             // how it was found
  double error_bar;              // m, the truth's, in the window
  bool under_contact_rule;       // the tolerance bounds a difference, no error
  double until;                  // s, the guarantee ends here
  std::vector<Trial> trials;     // everything tried, in order
  size_t chosen;                 // of the trials
  std::optional<size_t> second;  // the cheapest other method that meets it
  std::vector<std::string> left_out;
  std::string toml;                // a scene file that runs as advised
  double checked;                  // m, the error of that file's own run
  std::vector<WishResult> wishes;  // and their values in that run
  std::vector<std::string> caveats;
};

/// All of mysim; beside spheres their `+events` too, where there is one.
std::vector<Method> advisable_methods(const Scene& scene);

/// Tries each method on the scene, and on the least model whose own error is half the tolerance at most. A step is
/// taken when it meets the tolerance, every smaller one that was tried does so too, and among them one of half its
/// length; steps are refined to 5 %. Errors are looked for after every step, not at the samples alone (dense_truth.h).
/// Methods that already cost four times the best are given up. Throws CannotGuarantee where no truth is known, its bar
/// is above a third of the tolerance, the tolerance is above the scene's motion, or no method meets it.
Advice advise(const Scene& scene, double tolerance, std::vector<Method> methods);

// The search for the cheapest run of a model by a method that meets a tolerance.

struct Candidate {
  std::string name;  // "full", or "without ..."
  Scene scene;
  std::vector<Ingredient> out;
};

/// Longest steps first, halved until they meet the tolerance, then refined. What is tried goes to the advice's trials;
/// a method that already costs four times the best of those before it is given up.
class Search {
 public:
  Search(Advice& advice, const DenseTruth& path) : advice_(advice), path_(path) {}

  void try_all(const Candidate& model, const Method& method);

 private:
  /// The run with that step, or with that relative tolerance; one that was done before is not done again.
  const Trial& run(const Run& run);
  const Trial& trial_at(long steps);  // so many between two samples
  const Trial& trial_at_tolerance(double relative);
  bool hopeless(const Trial& t) const;
  bool too_costly(long steps) const;
  bool may_improve(double cost, double ratio) const { return cost * ratio < best_; }
  double cost_limit() const { return std::min(4 * best_, 1e9); }
  void search_steps();
  void search_tolerances();
  void record_cost(double cost) { best_ = std::min(best_, cost); }

  Advice& advice_;
  const DenseTruth& path_;
  const Candidate* model_ = nullptr;
  const Method* method_ = nullptr;
  std::optional<double> limit_;
  double best_ = INFINITY;
};

}  // namespace crosscheck
