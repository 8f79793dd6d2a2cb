// Failed cases of a regression run: the time at which both runs diverge, and figures.
#pragma once

#include <string>
#include <vector>

#include "experiments/experiment.h"
#include "experiments/regress/regress.h"
#include "report/page/page.h"

namespace crosscheck {

/// A failed case with its figures.
struct FailurePart {
  std::string scene, heading;
  std::string text;  // when and how the two runs diverge
  std::vector<PageImage> images;
};

/// Repeats the runs of the case (with --against, under both methods), and draws into OUT/figures both curves, their
/// difference over time with its tolerance, and both shapes side by side. Appends figures that cannot be drawn to
/// `problems`.
FailurePart drawn_failure(const Case& test_case, const std::vector<Comparison>& rows, const Regression& regression,
                          const Provenance& lines, std::vector<std::string>& problems);

/// At most `most` failed cases to draw. The order is: first one case per scene, preferring its own method and the whole
/// scene over a scene without an ingredient; then the largest deviations.
std::vector<Case> failures_to_draw(const std::vector<Case>& all, const std::vector<Comparison>& rows, int most);

}  // namespace crosscheck
