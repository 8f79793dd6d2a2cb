// Regression: runs the cases in parallel, compares them with baselines or with another method, and blesses new
// baselines.
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
  std::optional<Method> against;    // replaces the baselines; then exactly one method is selected
  std::filesystem::path baselines;  // folder
  std::filesystem::path out;        // folder for finished points
  LockPatience patience = LockPatience();
};

struct RegressionResult {
  std::vector<Comparison> rows;       // in the order of the cases; failures of files come first
  std::vector<FailedPoint> failures;  // cases without a result: a crash
  /// True if some case did not refuse its scene.
  bool measured() const;
  /// True if something was measured and nothing failed.
  bool passed() const;
};

/// Runs all selected cases and compares. Ignores baseline rows that are not selected (slow rows in a quick run, other
/// methods). A scene without a baseline, or with that of another scene, fails. A quantity or a method that the baseline
/// does not contain is new, which is no failure.
RegressionResult regress(const Regression& regression, Progress& progress);

struct BlessResult {
  bool measured = false;                                             // some case did not refuse its scene
  std::vector<Comparison> changed;                                   // before and after
  std::vector<std::pair<std::filesystem::path, std::string>> files;  // to be written, with their text
  std::map<std::string, int> numbers;                                // number of the blessing in each changed baseline
};
/// Runs the cases with tolerances. Quantities that moved, are new or are gone enter the new baselines under this
/// blessing; unchanged rows keep theirs. Writes nothing. Throws InputError if a file cannot be read, if only a part of
/// a stale file is selected (the rest would remain stale), or if a case has no result.
BlessResult bless(const Regression& regression, const Blessing& blessing, Progress& progress);

}  // namespace crosscheck
