// Details of a failed case: both runs over time, where they diverge, and figures of them.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "experiments/experiment.h"
#include "experiments/regress/regress.h"
#include "report/page/page.h"

namespace crosscheck {

using Series = std::vector<std::pair<double, double>>;  // over time, s

struct FailureDetails {
  Case test_case;
  std::vector<Comparison> rows;            // of the case, those that failed first
  Series was, is;                          // RMS displacement of the particles, m
  bool was_sampled = false;                // the whole old curve is known, not a few points of it
  Series difference, tolerance;            // of positions, m
  std::optional<double> first_divergence;  // s: the first time at which they differ by more than the tolerance
  std::optional<MethodResult> old_result, new_result;  // for pictures; of a baseline the scene's own method only
};

/// Runs the case again, with --against under both methods. Everything may be empty: a refused run has no curve.
FailureDetails failure_details(const Case& test_case, const std::vector<Comparison>& rows,
                               const Regression& regression);

/// At most `most` failed cases to draw: first one of each scene, its own method before others, whole scenes before
/// those without an ingredient, then those with the largest deviations.
std::vector<Case> failures_to_draw(const std::vector<Case>& all, const std::vector<Comparison>& rows, int most);

// Figures and pictures of a failed case.

/// Draws into OUT/figures the details: both curves, the difference over time with its tolerance, and both shapes side
/// by side. What cannot be drawn is added to
/// `problems`.
std::vector<PageImage> failure_figures(const FailureDetails& details, const Provenance& lines,
                                       const std::filesystem::path& out, std::vector<std::string>& problems);

/// When and how the two runs diverge, in a sentence or two.
std::string describe_divergence(const FailureDetails& details);

}  // namespace crosscheck
