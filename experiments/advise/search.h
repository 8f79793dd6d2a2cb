// The search for the cheapest run of a model by a method that meets a tolerance.
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "experiments/adequacy/ingredients.h"
#include "experiments/advise/advice.h"
#include "experiments/advise/true_path.h"

namespace crosscheck {

struct Candidate {
  std::string name;  // "full", or "without ..."
  Scene scene;
  std::vector<Ingredient> out;
};

/// Longest steps first, halved until they meet the tolerance, then refined. What is tried goes to the advice's trials;
/// a method that already costs four times the best of those before it is left.
class Search {
 public:
  Search(Advice& advice, const TruePath& path) : advice_(advice), path_(path) {}

  void over(const Candidate& model, const Method& method);

 private:
  /// The run with that step, or with that relative tolerance; one that was done before is not done again.
  const Trial& run(const Run& run);
  const Trial& at(long steps);  // between two samples
  const Trial& at_tolerance(double relative);
  bool hopeless(const Trial& t) const;
  bool too_dear(long steps) const;
  bool worth(double cost, double ratio) const { return cost * ratio < best_; }
  double dearest() const { return std::min(4 * best_, 1e9); }
  void over_steps();
  void over_tolerances();
  void keep(double cost) { best_ = std::min(best_, cost); }

  Advice& advice_;
  const TruePath& path_;
  const Candidate* model_ = nullptr;
  const Method* method_ = nullptr;
  std::optional<double> limit_;
  double best_ = INFINITY;
};

}  // namespace crosscheck
