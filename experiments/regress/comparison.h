// Comparison of quantities with their baselines: the status of each quantity, and the size of the difference.
#pragma once

#include <span>

#include "experiments/regress/baseline.h"

namespace crosscheck {

/// Failures come first: all values before `added`.
enum class Status {
  moved,       // differs by more than the tolerance, or is another word
  not_finite,  // NaN or infinite, or the verdict nan
  gone,        // blessed and selected, but no longer measured
  missing,     // the scene has no baseline file
  stale,       // the baseline belongs to another scene with the same name
  unreadable,  // the file is not a baseline
  added,       // not blessed yet: one quantity, or all quantities of a method
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
  std::string note;  // such as the error in a file
  /// Difference from the baseline in units of the tolerance; 0 for words, infinite for counts.
  double off() const;
  /// Sort key for reports, in which words come first, then numbers by off(), then counts.
  double rank() const;
};

/// Compares one case's quantities with its baseline. If there is no baseline, all quantities are new.
std::vector<Comparison> compared(const Case& test_case, const std::vector<Quantity>& is,
                                 const std::vector<BaselineRow>& expected);

/// Only the failed row with the largest rank for each case and status, so that a thousand rows fit on a screen.
std::vector<Comparison> worst_comparisons(const std::vector<Comparison>& rows);

/// A method whose quantities are all new in some scenes. Either it was added after the baselines of these scenes were
/// blessed, or it is slow and they were blessed in a quick run.
struct NewMethod {
  std::string method;
  size_t scenes = 0, quantities = 0;
};
std::vector<NewMethod> new_methods(std::span<const Comparison> rows);

std::vector<BaselineRow> baseline_rows_of(const Baseline& baseline, const Case& test_case);

}  // namespace crosscheck
