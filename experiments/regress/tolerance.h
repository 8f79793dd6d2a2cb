// The change that rounding explains: the tolerance of each quantity, found by measurement.
#pragma once

#include "experiments/regress/cases.h"

namespace crosscheck {

struct QuantityWithTolerance {
  Quantity quantity;
  double tolerance = 0;    // in the quantity's unit; 0 for words and counts: they must be equal
  std::string derivation;  // short: derivations.txt explains it
};

/// m: what all roundings of a run amount to as a change of the start.
struct Rounding {
  double size;
  std::string kind;
  double one_step = 0;  // m: of rules that solve an equation in each step, what that leaves
};
Rounding rounding_of(const Case& test_case, const CaseRun& case_run);

/// The case's quantities with their tolerances: the start is moved by a little in three seeded sets of directions,
/// and the largest change of the quantity, scaled from that little to the rounding, is what rounding can do to it; the
/// last digits of the number itself come on top. A quantity that is zero but for rounding is bounded relative to the
/// largest one of its unit. Not scaled: the time at which a run failed, and what is beyond prediction, which a fourth,
/// far smaller change shows.
std::vector<QuantityWithTolerance> with_tolerances(const Case& test_case);

}  // namespace crosscheck
