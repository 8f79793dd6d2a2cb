// One step has an error of order h^4. The number of steps in a fixed time is proportional to 1 / h, and errors add up
// twice, so that the total error is of order h^2.
#include <cmath>

#include "beliefs.h"

double verlet_next(double before, double now, double acceleration, double h) {
  return 2 * now - before + h * h * acceleration;
}

double observed_order(const std::vector<double>& errors) {
  return std::log2(errors.front() / errors.back()) / static_cast<double>(errors.size() - 1);
}

double predicted_error(double error, double times_smaller) { return error / (times_smaller * times_smaller); }
