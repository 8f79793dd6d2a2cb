// Regression: runs cases in parallel, compares them with baselines or another method, and blesses new baselines.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "experiments/regress/cases.h"
#include "experiments/regress/comparison.h"
#include "experiments/regress/tolerance.h"
#include "experiments/sweep/sweep.h"

namespace crosscheck {

struct Regression {
  Selection selection;
  std::optional<Method> against;    // replaces the baselines; requires that exactly one method is selected
  std::filesystem::path baselines;  // folder
  std::filesystem::path out;        // folder for finished points
  LockPatience patience = LockPatience();
};

struct RegressionResult {
  std::vector<Comparison> rows;       // in the order of the cases; failures of files come first
  std::vector<FailedPoint> failures;  // cases without a result, because of a crash
  /// True if some method accepted its scene.
  bool measured() const;
  bool passed() const;
};

/// Runs and compares all selected cases. Ignores baseline rows that are not selected (slow rows in a quick run, other
/// methods). Fails for a scene without a baseline or with the baseline of another scene, but not for a new quantity or
/// method.
RegressionResult regress(const Regression& regression, Progress& progress);

struct BlessResult {
  bool measured = false;
  std::vector<Comparison> changed;                                   // before and after
  std::vector<std::pair<std::filesystem::path, std::string>> files;  // paths and contents of the files to write
  std::map<std::string, int> numbers;                                // number of the blessing in each changed baseline
};
/// Runs the cases with tolerances. Changed, new and removed quantities are recorded in the new baselines under this
/// blessing; other rows are kept. Writes nothing. Throws InputError if a file cannot be read, if a case has no result,
/// or if only some cases of a stale file are selected (the rest would remain stale).
BlessResult bless(const Regression& regression, const Blessing& blessing, Progress& progress);

}  // namespace crosscheck
