// Writes each condition as a function, and solves it with root_of.
#include <cmath>

#include "beliefs.h"

double catenary_sag(double length, double span) {
  // 2 a sinh(s / 2a) = L and L^2 / 4 = sag^2 + 2 a sag
  const double u = root_of([&](double x) { return span * std::sinh(x) - x * length; });
  return std::tanh(u / 2) * length / 2;
}

double parabola_sag(double length, double span) {
  const auto arc = [&](double sag) {
    const double t = 4 * sag / span;
    return span / 2 * (std::hypot(1, t) + std::log(t + std::hypot(1, t)) / t);
  };
  return root_of([&](double sag) { return length - arc(sag); });
}

double elastic_sag(double length, double span, double weight, double stiffness) {
  const auto width = [&](double across) {
    const double slope = weight * length / (2 * across);
    return length * (std::asinh(slope) / slope + across / stiffness);
  };
  const double across = root_of([&](double t) { return span - width(t); });
  const double slope = weight * length / (2 * across);
  return length / 2 * std::tanh(std::asinh(slope) / 2) + weight * length * length / stiffness / 8;
}
