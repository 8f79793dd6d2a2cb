// Bisection of the error.
#include <cmath>

#include "stiff.h"

double predicted_step(Rule rule, double omega, double duration, double tolerance) {
  const double most = largest_stable_step(rule, omega, 0.0);
  if (most <= 0) return 0;
  auto error = [&](double h) {
    const double z = h * omega, turns = omega * duration;
    if (rule == Rule::rk4) return turns * z * z * z * z / 120;
    if (rule == Rule::implicit_euler) return turns * z / 2;
    return turns * z * z / 24;
  };
  double low = 0, high = std::fmin(0.9 * most, duration);
  if (error(high) <= tolerance)
    low = high;
  else
    for (int i = 0; i < 100; i++) {
      const double middle = (low + high) / 2;
      (error(middle) <= tolerance ? low : high) = middle;
    }
  int steps = 1;
  while (duration / steps > low) steps++;
  return duration / steps;
}

double measured_step(const std::function<Vector(double)>& run, int order, double h, double tolerance) {
  const Vector one = run(h), two = run(h / 2);
  double twofold = 1;
  for (int i = 0; i < order; i++) twofold *= 2;
  double error = 0;
  for (size_t i = 0; i < one.size(); i++) {
    const double better = (twofold * two[i] - one[i]) / (twofold - 1);  // the leading error cancels
    error = std::fmax(error, std::fabs(one[i] - better));
  }
  return error > 0 ? h / std::pow(error / tolerance, 1. / order) : h;
}
