// With the standard algorithms.
#include <algorithm>

#include "steppers.h"

static State plus(const State& a, double h, const State& b) {
  State sum(a.size());
  std::transform(a.begin(), a.end(), b.begin(), sum.begin(), [h](double p, double q) { return p + h * q; });
  return sum;
}

State trapezoidal_step(const Derivative& f, double t, const State& x, double h) {
  auto f0 = f(t, x);
  auto f1 = f(t + h, plus(x, h, f0));
  return plus(plus(x, 0.5 * h, f0), 0.5 * h, f1);
}
