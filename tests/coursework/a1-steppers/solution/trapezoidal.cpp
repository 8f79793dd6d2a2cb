// The explicit trapezoidal rule: the mean of the slope at the start and of the slope where Euler would land.
#include "steppers.h"

State trapezoidal_step(const Derivative& f, double t, const State& x, double h) {
  const State f0 = f(t, x);
  State landing = x;
  for (std::size_t i = 0; i < x.size(); ++i) landing[i] += h * f0[i];
  const State f1 = f(t + h, landing);
  State next = x;
  for (std::size_t i = 0; i < x.size(); ++i) next[i] += h / 2 * (f0[i] + f1[i]);
  return next;
}
