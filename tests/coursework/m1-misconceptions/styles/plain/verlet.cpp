// Repeats the previous displacement, and adds the effect of the force.
#include <cmath>

#include "beliefs.h"

double verlet_next(double before, double now, double acceleration, double h) {
  const double move = now - before;
  return now + move + acceleration * h * h;
}

double observed_order(const std::vector<double>& errors) {
  double sum = 0;
  for (std::size_t i = 1; i < errors.size(); ++i) sum += std::log(errors[i - 1] / errors[i]) / std::log(2.0);
  return sum / static_cast<double>(errors.size() - 1);
}

double predicted_error(double error, double times_smaller) { return error * std::pow(times_smaller, -2); }
