// All rules use the same method: the 2 x 2 matrix of a step on (u, v), its spectral radius, and the first step from
// which on the radius exceeds 1.
#include <cmath>
#include <limits>

#include "stiff.h"

namespace {

struct M {
  double a, b, c, d;
};
M operator*(const M& l, const M& r) {
  return {l.a * r.a + l.b * r.c, l.a * r.b + l.b * r.d, l.c * r.a + l.d * r.c, l.c * r.b + l.d * r.d};
}
M polynomial(const M& z, int order) {
  M sum = {1, 0, 0, 1}, power = sum;
  for (int i = 1; i <= order; ++i) {
    power = power * z;
    const double f = std::tgamma(i + 1.0);
    sum = {sum.a + power.a / f, sum.b + power.b / f, sum.c + power.c / f, sum.d + power.d / f};
  }
  return sum;
}

M step_of(Rule rule, double w, double g, double h) {
  const M z = {0, h, -h * w * w, -h * g};
  switch (rule) {
    case Rule::explicit_euler:
      return polynomial(z, 1);
    case Rule::trapezoidal:
      return polynomial(z, 2);
    case Rule::rk4:
      return polynomial(z, 4);
    case Rule::symplectic_euler:
      return M{1, h, 0, 1} * M{1, 0, -h * w * w, 1 - h * g};
    default:
      break;
  }
  const M drift = {1, h / 2, 0, 1}, kick = {1, 0, -h * w * w / (1 + h * g / 2), (1 - h * g / 2) / (1 + h * g / 2)};
  return drift * kick * drift;
}

double radius(const M& m) {
  const double half = (m.a + m.d) / 2, det = m.a * m.d - m.b * m.c, root = half * half - det;
  return root < 0 ? std::sqrt(det) : std::fabs(half) + std::sqrt(root);
}

}  // namespace

double largest_stable_step(Rule rule, double omega, double gamma) {
  const double every = std::numeric_limits<double>::infinity();
  if (rule == Rule::implicit_euler || omega + gamma <= 0) return every;
  // For small h, growth of order h^4 is hidden by round-off: without drag the trapezoidal rule always grows.
  if (rule == Rule::trapezoidal && gamma == 0) return 0;
  // Without a spring one eigenvalue is 1. If the other eigenvalue is near 1, the radius of the matrix is accurate to
  // only eight digits; the determinant equals the other eigenvalue and is fully accurate.
  auto stable = [&](double h) {
    const M m = step_of(rule, omega, gamma, h);
    return (omega == 0 ? std::fabs(m.a * m.d - m.b * m.c) : radius(m)) < 1 + 1e-12;
  };
  const double longest = 8 / std::fmax(omega, gamma) + 8 * gamma / (omega * omega + gamma * gamma),
               part = longest / 20000;
  if (!stable(part)) return 0;
  for (int i = 1; i <= 20000; ++i) {
    if (stable(i * part)) continue;
    double low = (i - 1) * part, high = i * part;
    while (high - low > 1e-14 * high) {
      const double middle = 0.5 * (low + high);
      if (middle == low || middle == high) break;
      if (stable(middle))
        low = middle;
      else
        high = middle;
    }
    return low;
  }
  return every;
}
