// Each curve has one unknown, found from the length or the span; the sag follows.
#include <cmath>

#include "beliefs.h"

double catenary_sag(double length, double span) {
  const auto too_long = [&](double a) { return 2 * a * std::sinh(span / (2 * a)) - length; };
  const double a = root_of(too_long, span / 100, span * 100);
  return a * (std::cosh(span / (2 * a)) - 1);
}

double parabola_sag(double length, double span) {
  const auto too_long = [&](double slope) {
    return span / 2 * (std::sqrt(1 + slope * slope) + std::asinh(slope) / slope) - length;
  };
  return span / 4 * root_of(too_long, 1e-6, 100);
}

double elastic_sag(double length, double span, double weight, double stiffness) {
  const double half = length / 2, pull = weight * half;  // of one end, upwards
  const auto too_wide = [&](double h) { return 2 * h / weight * std::asinh(pull / h) + h * length / stiffness - span; };
  const double h = root_of(too_wide, pull / 1e6, pull * 1e3);
  return (std::sqrt(h * h + pull * pull) - h) / weight + pull * half / (2 * stiffness);
}
