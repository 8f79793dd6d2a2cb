// The factor of the slowest error, without and with acceleration.
#include <algorithm>
#include <cmath>

#include "solvers.h"

namespace {

double size_of(const std::vector<double>& error) {
  double sum = 0;
  for (const double e : error) sum += e * e;
  return std::sqrt(sum);
}

}  // namespace

double spectral_radius(const Pass& pass, std::vector<double> error) {
  for (int k = 0; k < 2000; ++k) {
    error = pass(error);
    const double size = size_of(error);
    for (double& e : error) e /= size;
  }
  return size_of(pass(error));
}

// z^2 - w mu z + (w - 1) = 0: two real solutions, or two complex ones whose product is w - 1
double factor(double mu, double rho) {
  const double w = 2 / (1 + std::sqrt(1 - rho * rho)), half = w * std::abs(mu) / 2;
  const double root = half * half - (w - 1);
  return root > 0 ? half + std::sqrt(root) : std::sqrt(w - 1);
}

double slower_from(double lowest, double highest) {
  const double radius = std::max(std::abs(lowest), std::abs(highest));
  if (radius >= 1) return 0;
  return 2 * radius / (1 + radius * radius);
}
