// Newton's method instead of bisection.
#include <cmath>

#include "beliefs.h"

double catenary_sag(double length, double span) {
  // sinh(u) / u = length / span; u = span / (2 a)
  double u = std::sqrt(6 * (length / span - 1));
  for (int i = 0; i < 50; ++i)
    u -= (std::sinh(u) - u * length / span) / (std::cosh(u) - length / span);
  return span / (2 * u) * (std::cosh(u) - 1);
}

double parabola_sag(double length, double span) {
  double t = 2;  // the slope at an end
  for (int i = 0; i < 50; ++i) {
    const double root = std::sqrt(1 + t * t), now = (root + std::asinh(t) / t) / 2;
    const double rate = (t / root + 1 / (t * root) - std::asinh(t) / (t * t)) / 2;
    t -= (now - length / span) / rate;
  }
  return span * t / 4;
}

double elastic_sag(double length, double span, double weight, double stiffness) {
  const double pull = weight * length / 2;
  double h = pull / 100;  // the pull along the span; Newton's method does not overshoot if it starts below the solution
  for (int i = 0; i < 100; ++i) {
    const double width = 2 * h / weight * std::asinh(pull / h) + h * length / stiffness;
    const double rate = 2 / weight * (std::asinh(pull / h) - pull / std::hypot(pull, h)) + length / stiffness;
    h -= (width - span) / rate;
  }
  return (std::hypot(h, pull) - h) / weight + weight * length * length / (8 * stiffness);
}
