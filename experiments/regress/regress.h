// Regression: runs the cases side by side and compares them with baselines or with another method; blesses new
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
  std::optional<Method> against;    // instead of baselines; then exactly one method is selected
  std::filesystem::path baselines;  // folder
  std::filesystem::path out;        // folder, for what is finished
  LockPatience patience = LockPatience();
};

struct RegressionResult {
  std::vector<Comparison> rows;       // in the order of the cases; failures of files stand first
  std::vector<FailedPoint> failures;  // cases without a result: a crash
  /// Some case did not refuse its scene.
  bool measured() const;
  /// Something was measured, and nothing failed.
  bool passed() const;
};

/// Runs all selected cases and compares. What a baseline expects and is not selected (slow rows in a quick run, other
/// methods) is left alone. A scene that has no baseline, or one of another scene, fails; a quantity or a method that
/// its baseline does not know is new, and fails nothing.
RegressionResult regress(const Regression& regression, Progress& progress);

struct BlessResult {
  bool measured = false;                                             // some case did not refuse its scene
  std::vector<Comparison> changed;                                   // before and after
  std::vector<std::pair<std::filesystem::path, std::string>> files;  // to be written, with their text
  std::map<std::string, int> numbers;                                // of the blessing in each changed scene's baseline
};
/// Runs the cases with tolerances; what moved, is new or is gone stands in the new baselines under this blessing, rows
/// that are the same keep theirs. Nothing is written yet. Throws InputError where a file cannot be read, where a part
/// of a stale one is selected (the rest would stay stale), and where a case has no result.
BlessResult bless(const Regression& regression, const Blessing& blessing, Progress& progress);

}  // namespace crosscheck
