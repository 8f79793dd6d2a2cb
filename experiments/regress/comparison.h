// Quantities beside their baselines: the status of each, and how different they are.
#pragma once

#include <span>

#include "experiments/regress/baseline.h"

namespace crosscheck {

// What is, beside what was.

/// Failures stand first; `fresh` is said and not held against anybody.
enum class Status {
  moved,       // off by more than the tolerance, or another word
  not_finite,  // nan or infinite
  gone,        // blessed, asked, and no longer there
  missing,     // a scene or method without any baseline
  stale,       // the baseline is of another scene by the same name
  unreadable,  // the file is no baseline
  added,       // not blessed yet
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
  /// What to look at first: words, then numbers by how far they are off, then counts.
  double rank() const;
};

/// One question's quantities beside those expected of it.
std::vector<Comparison> compared(const Case& test_case, const std::vector<Quantity>& is,
                                 const std::vector<BaselineRow>& expected);

/// Of each question and standing the failed row that is off most, so that a thousand rows are read in a screen.
std::vector<Comparison> worst_comparisons(const std::vector<Comparison>& rows);

/// The rows of `baseline` that belong to the question.
std::vector<BaselineRow> baseline_rows_of(const Baseline& baseline, const Case& test_case);

// How close answers are to their baselines where they need not be the same bits: other compilers round otherwise.

/// Of the rows that have both a value that was and one that is.
struct Difference {
  size_t identical = 0, differing = 0;  // to the last bit, and not
  std::optional<Comparison> furthest;   // of those that differ the one that is most tolerances off; words first
};
Difference difference_of(std::span<const Comparison> rows);

}  // namespace crosscheck
