// The verdict of a regression run: CSV, JSON, JUnit, and a page.
#pragma once

#include "experiments/regress/regress.h"
#include "report/commands/regress_failure.h"
#include "report/page/page.h"

namespace crosscheck {

// The verdict of a regression run for people and programs: CSV, JSON, JUnit.

/// regress.csv (every quantity), regress.json (failures, counts) and junit.xml (one case for each scene and method) in
/// the folder.
void write_verdict(const RegressionResult& result, const Provenance& lines, const std::filesystem::path& folder);

// The page of a regression run: each move with its size, and pictures.

/// A failed case with its pictures.
struct FailurePart {
  std::string scene, heading, text;
  std::vector<PageImage> images;
};

struct VerdictPage {
  const RegressionResult& result;
  std::string blessed;  // why, where these changes are blessed; empty elsewhere
  std::string beside;   // "baselines in ..." or the other method
  std::vector<FailurePart> parts;
  std::vector<std::string> problems;  // what could not be drawn
  Provenance lines;
};

/// Writes OUT/index.html with its parts: the figures of at most `figures` failed cases. What cannot be drawn is
/// said there and on stderr.
void write_verdict_page(VerdictPage& page, const std::vector<Case>& cases, const Regression& regression, int figures);

/// "512 quantities in 20 scenes, not blessed yet"
std::string describe(const NewMethod& method);

/// "was 1, is 2 m; tolerance 1e-12, 3e11 tolerances off"
std::string describe_change(const Comparison& row);

}  // namespace crosscheck
