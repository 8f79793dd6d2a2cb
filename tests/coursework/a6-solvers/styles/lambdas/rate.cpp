// Uses Rayleigh's quotient of two passes, and complex roots.
#include <algorithm>
#include <complex>
#include <numeric>

#include "solvers.h"

double spectral_radius(const Pass& pass, std::vector<double> error) {
  const auto dot = [](const std::vector<double>& a, const std::vector<double>& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
  };
  double squared = 0;
  for (int k = 0; k < 1500; ++k) {
    const std::vector<double> once = pass(error), twice = pass(once);
    squared = dot(error, twice) / dot(error, error);
    const double size = std::sqrt(dot(twice, twice));
    error = twice;
    std::for_each(error.begin(), error.end(), [&](double& e) { e /= size; });
  }
  return std::sqrt(squared);
}

double factor(double mu, double rho) {
  const double w = 2 / (1 + std::sqrt((1 - rho) * (1 + rho)));
  const std::complex<double> p = w * mu, root = std::sqrt(p * p - 4 * (w - 1));
  return std::max(std::abs(p + root), std::abs(p - root)) / 2;
}

double slower_from(double lowest, double highest) {
  const double r = std::max(-lowest, highest);
  return r < 1 ? 2 / (r + 1 / r) : 0;
}
