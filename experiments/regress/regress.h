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
  std::optional<Method> against;    // replaces the baselines and requires exactly one selected method
  std::filesystem::path baselines;  // folder
  std::filesystem::path out;        // folder for finished points
  LockPatience patience = LockPatience();
};

struct RegressionResult {
  std::vector<Comparison> rows;       // in the order of the cases; failures of files come first
  std::vector<FailedPoint> failures;  // cases without a result, i.e. crashes
  /// True if some method accepted its scene.
  bool measured() const;
  bool passed() const;
};

/// Runs and compares all selected cases. Ignores baseline rows that are not selected (slow rows in a quick run, other
/// methods). A scene without a baseline, or with that of another scene, fails; a new quantity or method does not.
RegressionResult regress(const Regression& regression, Progress& progress);

struct BlessResult {
  bool measured = false;                                             // some method accepted its scene
  std::vector<Comparison> changed;                                   // before and after
  std::vector<std::pair<std::filesystem::path, std::string>> files;  // to be written, with their text
  std::map<std::string, int> numbers;                                // number of the blessing in each changed baseline
};
/// Runs the cases with tolerances. Quantities that moved, are new or are gone enter the new baselines under this
/// blessing; other rows keep theirs. Writes nothing. Throws InputError if a file cannot be read, if a case has no
/// result, or if a stale file is selected in part (the rest would remain stale).
BlessResult bless(const Regression& regression, const Blessing& blessing, Progress& progress);

}  // namespace crosscheck
