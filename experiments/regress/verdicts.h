// What is, beside what was.
#pragma once

#include "experiments/regress/baseline.h"

namespace crosscheck {

/// Failures stand first; `fresh` is said and not held against anybody.
enum class Standing {
  moved,       // off by more than the tolerance, or another word
  not_finite,  // nan or infinite
  gone,        // blessed, asked, and no longer there
  missing,     // a scene or method without any baseline
  stale,       // the baseline is of another scene by the same name
  unreadable,  // the file is no baseline
  fresh,       // not blessed yet
  same,
};
std::string_view name_of(Standing state);
inline bool failed(Standing state) { return state < Standing::fresh; }

struct Compared {
  std::string scene, method, without, quantity, unit;
  std::optional<double> was, is;
  std::string was_word, is_word;
  double tolerance = 0;
  Standing state = Standing::same;
  std::string note;  // what else is to be said, e.g. what is wrong with a file
  /// How many tolerances it is off; 0 for words, infinite for counts.
  double off() const;
  /// What to look at first: words, then numbers by how far they are off, then counts.
  double rank() const;
};

/// One question's quantities beside those expected of it.
std::vector<Compared> compared(const Question& question, const std::vector<Quantity>& is,
                               const std::vector<Expected>& expected);

/// Of each question and standing the failed row that is off most, so that a thousand rows are read in a screen.
std::vector<Compared> worst_of_each(const std::vector<Compared>& rows);

/// The rows of `baseline` that belong to the question.
std::vector<Expected> expected_of(const Baseline& baseline, const Question& question);

}  // namespace crosscheck
