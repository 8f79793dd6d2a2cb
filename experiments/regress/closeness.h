// How close answers are to their baselines where they need not be the same bits: other compilers round otherwise.
#pragma once

#include <span>

#include "experiments/regress/verdicts.h"

namespace crosscheck {

/// Of the rows that have both a value that was and one that is.
struct Closeness {
  size_t identical = 0, differing = 0;  // to the last bit, and not
  std::optional<Compared> furthest;     // of those that differ the one that is most tolerances off; words first
};
Closeness closeness_of(std::span<const Compared> rows);

}  // namespace crosscheck
