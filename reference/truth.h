// The best answer known for a scene, with its tier and its error bar.
#pragma once

#include <cmath>
#include <optional>
#include <string>

#include "mysim/observers/trajectory.h"

namespace crosscheck {

enum class Tier { exact = 1, exact_discrete = 2, converged = 3, another_engine = 4 };
std::string_view name_of(Tier tier);

struct Truth {
  Tier tier;
  std::string how;  // one sentence
  Trajectory trajectory;
  double bar;                // m, error bar of the RMS position error, at any sample
  std::vector<double> bars;  // m, the same up to each sample; empty where it is one and the same
  // the answer of the in-house contact rule: what others are apart from it is a difference, and no error
  bool of_contact_rule = false;
  double until = INFINITY;  // s, holds up to here; the samples end with it
};

/// Exact where the scene has a closed form (bar: round-off, 1e-15 x scene size x (1 + radians turned)); otherwise
/// converged on two independent routes (converged.h), found once and kept in a cache (truth_cache.h). Of other
/// scenes with contact only what the in-house contact rule converges to is known, for a while (contact_truth.h).
std::optional<Truth> truth_of(const Scene& scene, const Run& run);

/// sqrt of the mean over the particles of |a_i - b_i|^2, m.
double rms_distance(const Points& a, const Points& b);
/// Its largest value over the samples that both have, up to `until` (s), m.
double largest_rms_distance(const Trajectory& a, const Trajectory& b, double until = INFINITY);

}  // namespace crosscheck
