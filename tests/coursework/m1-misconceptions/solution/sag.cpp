// Each curve has one unknown, which follows from the length or the span, and determines the sag.
#include <cmath>

#include "beliefs.h"

double catenary_sag(double length, double span) {
  const double a = root_of([&](double at) { return 2 * at * std::sinh(span / (2 * at)) - length; });
  return a * (std::cosh(span / (2 * a)) - 1);
}

double parabola_sag(double length, double span) {
  return span / 4 * root_of([&](double slope) {
           return span / 2 * (std::sqrt(1 + slope * slope) + std::asinh(slope) / slope) - length;
         });
}

double elastic_sag(double length, double span, double weight, double stiffness) {
  const double pull = weight * length / 2;  // vertical pull at one end
  const double h = root_of([&](double across) {
    return 2 * across / weight * std::asinh(pull / across) + across * length / stiffness - span;
  });
  return (std::sqrt(h * h + pull * pull) - h) / weight + pull * length / (4 * stiffness);
}
