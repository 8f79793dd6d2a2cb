// The classic Runge-Kutta rule: a slope at the start, two in the middle, one at the end, weighted 1 : 2 : 2 : 1.
#include "steppers.h"

namespace {

/// x + h slope
State moved(const State& x, double h, const State& slope) {
  State there = x;
  for (std::size_t i = 0; i < there.size(); ++i) there[i] += h * slope[i];
  return there;
}

}  // namespace

State rk4_step(const Derivative& f, double t, const State& x, double h) {
  const State k1 = f(t, x);
  const State k2 = f(t + h / 2, moved(x, h / 2, k1));
  const State k3 = f(t + h / 2, moved(x, h / 2, k2));
  const State k4 = f(t + h, moved(x, h, k3));
  State mean = x;
  for (std::size_t i = 0; i < mean.size(); ++i) mean[i] = (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]) / 6;
  return moved(x, h, mean);
}
