// With the standard algorithms.
#include <algorithm>

#include "steppers.h"

State euler_step(const Derivative& f, double t, const State& x, double h) {
  State rate = f(t, x);
  std::transform(x.begin(), x.end(), rate.begin(), rate.begin(), [h](double a, double b) { return a + h * b; });
  return rate;
}
