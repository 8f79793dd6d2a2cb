#pragma once

#include <string>
#include <vector>

#include "experiments/experiment.h"
#include "experiments/regress/regress.h"
#include "report/page/page.h"

namespace crosscheck {

struct FailurePart {
  std::string scene, heading;
  std::string text;  // when and how the two runs diverge
  std::vector<PageImage> images;
};

/// Repeats the runs of the case (with --against, under both methods). Draws three figures into OUT/figures: both
/// curves, their difference over time with its tolerance, and both shapes side by side. Appends the reasons to
/// `problems` if figures cannot be drawn.
FailurePart drawn_failure(const Case& test_case, const std::vector<Comparison>& rows, const Regression& regression,
                          const Provenance& lines, std::vector<std::string>& problems);

/// Selects at most `most` failed cases: first one per scene, preferably with its own method and without removed
/// ingredients; then those with the largest deviations.
std::vector<Case> failures_to_draw(const std::vector<Case>& all, const std::vector<Comparison>& rows, int most);

}  // namespace crosscheck
