// How far the true motion of a scene goes, good to some per cent: enough to tell whether a run goes ten times as far.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <utility>

#include "mysim/run.h"

namespace crosscheck {

struct Reach {
  double speed = 0;    // m/s, the largest of a free particle
  double stretch = 0;  // 1, the largest length of a spring over its length at rest (at the start, where that is zero)
};

/// The largest length of a spring over its length at rest; 0 without springs.
double largest_stretch(const Model& model, const State& start, const Points& x);

/// Leapfrog over the run's duration at a quarter of its limit on the fastest vibration there can be, where a
/// vibration's speed is right to 3 %. Nothing where leapfrog does not take the scene, or fails.
std::optional<Reach> reach_of(const Scene& scene, const Run& run);

using ReachFunction = std::function<std::optional<Reach>(const Scene&, const Run&)>;

/// reach_of() for who runs one scene again and again: each duration is computed once.
class RememberedReach {
 public:
  std::optional<Reach> operator()(const Scene& scene, const Run& run) {
    const auto [at, is_new] = known_.try_emplace({run.duration, run.samples});
    if (is_new) at->second = reach_of(scene, run);
    return at->second;
  }

 private:
  std::map<std::pair<double, int>, std::optional<Reach>> known_;  // by duration (s) and samples
};

}  // namespace crosscheck
