// One step is off by h^4; over a fixed time there are more of them the smaller they are, and they add up twice.
#include <cmath>

#include "beliefs.h"

double verlet_next(double before, double now, double acceleration, double h) {
  return 2 * now - before + h * h * acceleration;
}

double observed_order(const std::vector<double>& errors) {
  return std::log2(errors.front() / errors.back()) / static_cast<double>(errors.size() - 1);
}

double predicted_error(double error, double times_smaller) { return error / (times_smaller * times_smaller); }
