// Writes the verdict of a regression run as CSV, JSON, JUnit and a page.
#pragma once

#include "experiments/regress/regress.h"
#include "report/commands/regress_failure.h"

namespace crosscheck {

/// Writes regress.csv (every quantity), regress.json (failures, counts) and junit.xml (one case per scene and method)
/// into the folder.
void write_verdict(const RegressionResult& result, const Provenance& lines, const std::filesystem::path& folder);

struct VerdictPage {
  const RegressionResult& result;
  std::string beside;   // "the baselines in ..." or the other method
  std::string blessed;  // reason, if these changes are blessed; otherwise empty
  Provenance lines;
};

/// Writes OUT/index.html with each change and its size, and the figures of at most `figures` failed cases, which it
/// returns. Figures that cannot be drawn are reported on the page and on stderr.
std::vector<FailurePart> write_verdict_page(const VerdictPage& page, const Regression& regression, int figures);

/// "chain, mysim/rk4 without gravity"
std::string case_of(const Comparison& row);

/// "mysim/rk4: 512 quantities in 20 scenes, not blessed yet; bless with --filter '*/mysim/rk4'"
std::string describe(const NewMethod& method);

/// "was 1, is 2 m; tolerance 1e-12, 3e11 tolerances off", or the row's note.
std::string describe_change(const Comparison& row);

}  // namespace crosscheck
