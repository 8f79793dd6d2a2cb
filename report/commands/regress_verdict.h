#pragma once

#include "experiments/regress/regress.h"
#include "report/commands/regress_failure.h"

namespace crosscheck {

/// Writes regress.csv (all quantities), regress.json (failures, counts) and junit.xml (one case per scene and method).
void write_verdict(const RegressionResult& result, const Provenance& lines, const std::filesystem::path& folder);

struct VerdictPage {
  const RegressionResult& result;
  std::string beside;   // "the baselines in ..." or the other method
  std::string blessed;  // reason to bless these changes; otherwise empty
  Provenance lines;
};

/// Writes OUT/index.html with each change, and returns the figures of at most `figures` failed cases. Reports figures
/// that cannot be drawn on the page and on stderr.
std::vector<FailurePart> write_verdict_page(const VerdictPage& page, const Regression& regression, int figures);

/// "chain, mysim/rk4 without gravity"
std::string case_of(const Comparison& row);

/// "mysim/rk4: 512 quantities in 20 scenes, not blessed yet; bless with --filter '*/mysim/rk4'"
std::string describe(const NewMethod& method);

/// "was 1, is 2 m; tolerance 1e-12, 3e11 tolerances off", or the row's note.
std::string describe_change(const Comparison& row);

}  // namespace crosscheck
