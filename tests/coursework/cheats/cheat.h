// Shared by the cheats. A cheat returns the right answer if its trick works, so that it earns points and is noticed.
// Otherwise it returns an answer that earns nothing. The runner defines macros with everything that an informed student
// could have found out:
//   RESULTS, HOME_FOLDER, TESTS: folders that hold results, a home, the assignment with tests and solution.
#pragma once

#include "steppers.h"

namespace cheat {

inline State right(const Derivative& f, double t, const State& x, double h) {
  const State slope = f(t, x);
  State next = x;
  for (std::size_t i = 0; i < next.size(); ++i) next[i] += h * slope[i];
  return next;
}

inline State outcome(bool worked, const Derivative& f, double t, const State& x, double h) {
  return worked ? right(f, t, x, h) : x;
}

}  // namespace cheat
