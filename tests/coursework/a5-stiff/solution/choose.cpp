// The error of a rule is constant * omega T * (h omega)^order, which is solved for h.
#include <algorithm>
#include <cmath>

#include "stiff.h"

namespace {

struct Accuracy {
  double order, constant;
};

Accuracy accuracy_of(Rule rule) {
  switch (rule) {
    case Rule::rk4:
      return {4, 1.0 / 120};
    case Rule::symplectic_euler:
    case Rule::leapfrog:
      return {2, 1.0 / 24};
    case Rule::trapezoidal:
      return {2, 1.0 / 6};
    case Rule::explicit_euler:
    case Rule::implicit_euler:
      break;
  }
  return {1, 1.0 / 2};
}

}  // namespace

double predicted_step(Rule rule, double omega, double duration, double tolerance) {
  const double limit = largest_stable_step(rule, omega, 0);
  if (limit == 0) return 0;
  const Accuracy rule_has = accuracy_of(rule);
  double h = std::pow(tolerance / (rule_has.constant * omega * duration), 1 / rule_has.order) / omega;
  h = std::min(h, 0.9 * limit);
  const double steps = std::ceil(duration / h);
  return duration / steps;
}

double measured_step(const std::function<Vector(double)>& run, int order, double h, double tolerance) {
  const Vector coarse = run(h), fine = run(h / 2);
  double difference = 0;
  for (std::size_t i = 0; i < coarse.size(); ++i) difference = std::max(difference, std::abs(coarse[i] - fine[i]));
  if (difference == 0) return h;
  const double power = std::pow(2.0, order);
  const double error = difference * power / (power - 1);
  return h * std::pow(tolerance / error, 1.0 / order);
}
