// Explicit Euler: the slope at the start, for the whole step.
#include "steppers.h"

State euler_step(const Derivative& f, double t, const State& x, double h) {
  const State slope = f(t, x);
  State next = x;
  for (std::size_t i = 0; i < next.size(); ++i) next[i] += h * slope[i];
  return next;
}
