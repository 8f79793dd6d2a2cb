// Closed forms if they exist; for the two Runge-Kutta rules, the first step at which |R(h lambda)| reaches 1.
#include <algorithm>
#include <cmath>
#include <complex>

#include "stiff.h"

namespace {

using Complex = std::complex<double>;

/// |R(z)| of a rule whose R is the Taylor polynomial of exp up to this order.
double size(int order, Complex z) {
  Complex sum = 1, power = 1;
  for (int i = 1; i <= order; ++i) {
    power *= z / static_cast<double>(i);
    sum += power;
  }
  return std::abs(sum);
}

double runge_kutta(int order, double omega, double gamma) {
  const Complex root = std::sqrt(Complex(gamma * gamma / 4 - omega * omega));
  const Complex slow = -gamma / 2 + root, fast = -gamma / 2 - root;
  auto grows = [&](double h) { return std::max(size(order, h * slow), size(order, h * fast)) > 1 + 1e-13; };
  const double far = 4 / std::max(std::abs(slow), std::abs(fast));
  double stable = 0, unstable = 0;
  while (unstable < far && !grows(unstable)) {
    stable = unstable;
    unstable += far / 1000;
  }
  for (int i = 0; i < 60; ++i) {
    const double middle = (stable + unstable) / 2;
    (grows(middle) ? unstable : stable) = middle;
  }
  return stable;
}

double explicit_euler(double omega, double gamma) {
  if (gamma < 2 * omega) return gamma / (omega * omega);
  const double fastest = (gamma + std::sqrt(gamma * gamma - 4 * omega * omega)) / 2;
  return 2 / fastest;
}

}  // namespace

double largest_stable_step(Rule rule, double omega, double gamma) {
  if (rule == Rule::implicit_euler) return HUGE_VAL;
  if (omega == 0 && gamma == 0) return HUGE_VAL;
  if (rule == Rule::explicit_euler) return explicit_euler(omega, gamma);
  if (rule == Rule::trapezoidal) return gamma == 0 ? 0 : runge_kutta(2, omega, gamma);
  if (rule == Rule::rk4) return runge_kutta(4, omega, gamma);
  if (rule == Rule::symplectic_euler) return 4 / (gamma + std::sqrt(gamma * gamma + 4 * omega * omega));
  return omega == 0 ? HUGE_VAL : 2 / omega;  // leapfrog
}
