// Comparison of quantities with their baselines: the status of each, and the size of the difference.
#pragma once

#include <span>

#include "experiments/regress/baseline.h"

namespace crosscheck {

/// Failures come first; all before `added` are failures.
enum class Status {
  moved,       // by more than the tolerance, or to another word
  not_finite,  // NaN or infinite, or the verdict nan
  gone,        // blessed and selected, but no longer measured
  missing,     // the scene has no baseline file
  stale,       // the baseline is of another scene with the same name
  unreadable,  // the file is not a baseline
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
  std::string note;  // e.g. the error in a file
  /// Difference in units of the tolerance; 0 for words, infinite for counts.
  double off() const;
  /// Sort key for reports: words first, then numbers by off(), then counts.
  double rank() const;
};

/// Compares one case's quantities with its baseline; without one, all quantities are new.
std::vector<Comparison> compared(const Case& test_case, const std::vector<Quantity>& is,
                                 const std::vector<BaselineRow>& expected);

/// The failed row with the largest rank of each case and status, so that a thousand rows fit on a screen.
std::vector<Comparison> worst_comparisons(const std::vector<Comparison>& rows);

/// A method whose quantities are all new in some scenes: it was added after their baselines were blessed, or is slow
/// and they were blessed in a quick run.
struct NewMethod {
  std::string method;
  size_t scenes = 0, quantities = 0;
};
std::vector<NewMethod> new_methods(std::span<const Comparison> rows);

std::vector<BaselineRow> baseline_rows_of(const Baseline& baseline, const Case& test_case);

}  // namespace crosscheck
