// The tolerance of each quantity: the largest change that rounding can explain, found by measurement.
#pragma once

#include "experiments/regress/cases.h"

namespace crosscheck {

struct QuantityWithTolerance {
  Quantity quantity;
  double tolerance = 0;    // in the quantity's unit; 0 for words and counts, which must be equal
  std::string derivation;  // short form; derivations.txt explains it
};

/// The total rounding error of a run, expressed as a change (m) of the start.
struct Rounding {
  double size;
  std::string kind;
  double one_step = 0;  // m, residual of the equation of a step, for rules that solve one
};
Rounding rounding_of(const Case& test_case, const CaseRun& case_run);

/// Moves the start by a small distance in three seeded sets of directions. The tolerance is the largest change of the
/// quantity, scaled from that distance to the rounding error, plus the last digits of the number itself. A quantity
/// that is zero except for rounding is bounded relative to the largest quantity with the same unit. Two kinds are not
/// scaled: the time at which a run failed, and unpredictable quantities, which are revealed by a fourth, much smaller
/// change of the start.
std::vector<QuantityWithTolerance> with_tolerances(const Case& test_case);

}  // namespace crosscheck
