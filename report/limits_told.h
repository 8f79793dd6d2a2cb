// What table `stability` says of theory: row by row, and in sentences for findings and charts alike.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/table.h"
#include "report/facts.h"

namespace crosscheck {

/// A largest stable step by theory beside the one measured.
struct LimitCompared {
  enum Kind {
    agrees,  // within 1 %, or both say that no step, or every step, is stable
    coarse,  // further off, but the search ended with theory's limit between what held and what failed
    apart
  } kind = agrees;
  std::optional<double> off;  // measured over predicted, less 1; where both are steps
  std::string how;            // of `apart`: "47 times as long", "holds at every step tried, by theory up to 1.2 ms"
};
/// Nothing where there is no theory, the method does not take the scene, or theory's limit lies beyond what was tried.
std::optional<LimitCompared> compared(const Table& stability, size_t row);

/// A sentence on the limits of all scenes that can rest, and one on those that theory looks at from their start.
struct LimitsTold {
  std::string sentence;
  bool at_rest, theory_holds;  // theory holds where no row is `apart`
};
std::vector<LimitsTold> limits_told(const Table& stability);

/// "-0.12 %", "47 times as long": of measured over predicted, less 1; "within ±0.07 %" where it is less than what the
/// search can tell, `finest`.
std::string apart_text(double off, double finest = 0);

}  // namespace crosscheck
