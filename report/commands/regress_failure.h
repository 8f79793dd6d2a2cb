// Failed cases of a regression run: when both runs diverge, and figures of them.
#pragma once

#include <string>
#include <vector>

#include "experiments/experiment.h"
#include "experiments/regress/regress.h"
#include "report/page/page.h"

namespace crosscheck {

/// A failed case with its pictures.
struct FailurePart {
  std::string scene, heading;
  std::string text;  // when and how the two runs diverge
  std::vector<PageImage> images;
};

/// Runs the case again, with --against under both methods, and draws into OUT/figures both curves, the difference over
/// time with its tolerance, and both shapes side by side. What cannot be drawn is added to `problems`.
FailurePart drawn_failure(const Case& test_case, const std::vector<Comparison>& rows, const Regression& regression,
                          const Provenance& lines, std::vector<std::string>& problems);

/// At most `most` failed cases to draw: first one of each scene, its own method before others, whole scenes before
/// those without an ingredient, then those with the largest deviations.
std::vector<Case> failures_to_draw(const std::vector<Case>& all, const std::vector<Comparison>& rows, int most);

}  // namespace crosscheck
