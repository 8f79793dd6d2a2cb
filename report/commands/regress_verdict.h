// The verdict of a regression run: CSV, JSON, JUnit, and a page.
#pragma once

#include "experiments/regress/regress.h"
#include "experiments/regress/speed_regression.h"
#include "experiments/tables/table.h"
#include "mysim/base/json.h"
#include "report/commands/regress_failure.h"
#include "report/page/page.h"

namespace crosscheck {

// The speed part of the files of a regression run.

/// speed-cost: every speed that was measured.
Table table_of(const Speeds& speeds);

/// Adds "speed" (an entry for every speed that was measured), "speed_notes" and "speed_failures" to the verdict.
void add_speeds(Json& verdict, const Speeds& speeds);

/// JUnit: a case for each speed that was compared.
struct JUnitCases {
  std::string body;
  size_t cases = 0, failures = 0, errors = 0;
};
JUnitCases junit_cases(const Speeds& speeds);

// The verdict of a regression run for people and programs: CSV, JSON, JUnit.

/// regress.csv (every quantity), regress.json (failures, counts, cause, speeds) and junit.xml (one case for each scene
/// and method, and one for its speed) in the folder; speed-cost.csv where speeds were measured. `cause` is empty where
/// it is not attributed.
void write_verdict(const RegressionResult& result, const Speeds& speeds, const std::string& cause,
                   const Provenance& lines, const std::filesystem::path& folder);

// The page of a regression run: what moved, by how much, why, and pictures of it.

/// A failed case with its figures.
struct FailurePart {
  std::string scene, heading, text;
  std::vector<PageImage> images;
  PageTable table;
};

struct VerdictPage {
  const RegressionResult& result;
  const Speeds& speeds;
  std::string cause;    // empty: not attributed
  std::string blessed;  // why, where these changes are blessed; empty elsewhere
  std::string beside;   // "baselines in ..." or the other method
  std::vector<FailurePart> parts;
  std::vector<std::string> problems;  // what could not be drawn
  Provenance lines;
};

/// Draws the failures (at most `most`) into OUT/figures. What cannot be drawn is added to `problems`.
std::vector<FailurePart> failure_parts(const std::vector<Case>& cases, const RegressionResult& result,
                                       const Regression& regression, int most, const Provenance& lines,
                                       std::vector<std::string>& problems);

/// Writes OUT/index.html with its parts: the figures of at most `figures` failed cases. What cannot be drawn is
/// said there and on stderr.
void write_verdict_page(VerdictPage& page, const std::vector<Case>& cases, const Regression& regression, int figures);

std::string verdict_html(const VerdictPage& page);

/// "512 quantities in 20 scenes, not blessed yet"
std::string describe(const NewMethod& method);

/// "was 1, is 2 m; tolerance 1e-12, 3e11 tolerances off"
std::string describe_change(const Comparison& row);

}  // namespace crosscheck
