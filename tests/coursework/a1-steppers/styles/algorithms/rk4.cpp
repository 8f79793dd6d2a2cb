// With the standard algorithms; adds the weighted slopes one after the other.
#include <algorithm>

#include "steppers.h"

static State plus(State a, double h, const State& b) {
  std::transform(a.begin(), a.end(), b.begin(), a.begin(), [h](double p, double q) { return p + h * q; });
  return a;
}

State rk4_step(const Derivative& f, double t, const State& x, double h) {
  auto k1 = f(t, x), k2 = f(t + 0.5 * h, plus(x, 0.5 * h, k1)), k3 = f(t + 0.5 * h, plus(x, 0.5 * h, k2)),
       k4 = f(t + h, plus(x, h, k3));
  return plus(plus(plus(plus(x, h / 6, k1), h / 3, k2), h / 3, k3), h / 6, k4);
}
