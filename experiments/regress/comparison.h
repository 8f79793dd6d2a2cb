// Quantities compared with their baselines: the status of each, and how different they are.
#pragma once

#include <span>

#include "experiments/regress/baseline.h"

namespace crosscheck {

/// Failures stand first; what is `added` is reported and fails nothing.
enum class Status {
  moved,       // off by more than the tolerance, or another word
  not_finite,  // nan or infinite, or the verdict nan
  gone,        // blessed, selected, and no longer there
  missing,     // the scene has no baseline file
  stale,       // the baseline is of another scene by the same name
  unreadable,  // the file is no baseline
  added,       // not blessed yet: a quantity, or all of a method
  same,
};
std::string_view name_of(Status state);
inline bool failed(Status state) { return state < Status::added; }

struct Comparison {
  std::string scene, method, without, quantity, unit;
  std::optional<double> was, is;
  std::string was_word, is_word;
  double tolerance = 0;
  Status state = Status::same;
  std::string note;  // what else is to be said, e.g. what is wrong with a file
  /// How many tolerances it is off; 0 for words, infinite for counts.
  double off() const;
  /// The order of reading: words, then numbers by how far they are off, then counts.
  double rank() const;
};

/// One case's quantities compared with its baseline; where none is expected all are new.
std::vector<Comparison> compared(const Case& test_case, const std::vector<Quantity>& is,
                                 const std::vector<BaselineRow>& expected);

/// Of each case and status the failed row that is off most, so that a thousand rows are read in a screen.
std::vector<Comparison> worst_comparisons(const std::vector<Comparison>& rows);

/// A method whose quantities are all new in some scenes: it joined after their baselines were blessed, or it is slow
/// and these were blessed in a quick run.
struct NewMethod {
  std::string method;
  size_t scenes = 0, quantities = 0;
};
/// Those of the rows, by name.
std::vector<NewMethod> new_methods(std::span<const Comparison> rows);

/// The rows of `baseline` that belong to the case.
std::vector<BaselineRow> baseline_rows_of(const Baseline& baseline, const Case& test_case);

}  // namespace crosscheck
