// Computes the steps through logarithms, and increases their number until they cover the duration.
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "stiff.h"

double predicted_step(Rule rule, double omega, double duration, double tolerance) {
  static const std::map<Rule, std::pair<int, double>> errors = {{Rule::rk4, {4, 120}},
                                                                {Rule::leapfrog, {2, 24}},
                                                                {Rule::symplectic_euler, {2, 24}},
                                                                {Rule::implicit_euler, {1, 2}}};
  const auto found = errors.find(rule);
  if (found == errors.end()) return 0;
  const auto [order, inverse] = found->second;
  const double accurate = std::exp(std::log(tolerance * inverse / (omega * duration)) / order) / omega;
  const double h = std::fmin(accurate, 0.9 * largest_stable_step(rule, omega, 0));
  long steps = static_cast<long>(duration / h);
  while (steps * h < duration) ++steps;
  return duration / static_cast<double>(steps);
}

double measured_step(const std::function<Vector(double)>& run, int order, double h, double tolerance) {
  Vector gap = run(0.5 * h);
  const Vector whole = run(h);
  std::transform(gap.begin(), gap.end(), whole.begin(), gap.begin(),
                 [](double l, double r) { return std::fabs(l - r); });
  const double most = *std::max_element(gap.begin(), gap.end());
  if (most <= 0) return h;
  // the error with h is most / (1 - 2^-order)
  return h * std::exp((std::log(tolerance) - std::log(most) + std::log1p(-std::exp2(-order))) / order);
}
