// The best answer known for a scene, with its tier and its error bar.
#pragma once

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
  double bar;  // m, error bar of the RMS position error, at any sample
};

/// Exact where the scene has a closed form (bar: round-off, 1e-15 x scene size x (1 + radians turned)); otherwise
/// converged: rk4 at a quarter of the scene's step (a sixteenth below 50 particles; at
/// h omega = 0.7 of its fastest vibration, if that is less) and at twice that, bar = the largest RMS difference of the
/// two over time (one route only). None where rk4 fails or the bar exceeds a hundredth of the motion. Scenes with
/// contact have none: what they converge to depends on the contact rule.
std::optional<Truth> truth_of(const Scene& scene, const Run& run);

/// sqrt of the mean over the particles of |a_i - b_i|^2, m.
double rms_distance(const Points& a, const Points& b);

}  // namespace crosscheck
