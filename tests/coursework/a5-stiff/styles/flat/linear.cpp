// Householder reflections on one flat array, then back substitution.
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "stiff.h"

Vector solve(Matrix a, Vector b) {
  const size_t n = b.size();
  std::vector<double> q(n * (n + 1));
  double big = 0;
  for (size_t i = 0; i < n; i++) {
    for (size_t j = 0; j < n; j++) {
      q[i * (n + 1) + j] = a[i][j];
      big = std::max(big, std::fabs(a[i][j]));
    }
    q[i * (n + 1) + n] = b[i];
  }
  auto at = [&](size_t i, size_t j) -> double& { return q[i * (n + 1) + j]; };
  for (size_t k = 0; k < n; k++) {
    double norm = 0;
    for (size_t i = k; i < n; i++) norm = std::hypot(norm, at(i, k));
    if (norm <= 1e-12 * big) throw std::domain_error("singular");
    const double alpha = at(k, k) > 0 ? -norm : norm;
    std::vector<double> u(n, 0.0);
    double uu = 0;
    for (size_t i = k; i < n; i++) {
      u[i] = (at(i, k) - (i == k ? alpha : 0)) / norm;
      uu += u[i] * u[i];
    }
    for (size_t j = k; j <= n; j++) {
      double dot = 0;
      for (size_t i = k; i < n; i++) dot += u[i] * at(i, j);
      for (size_t i = k; i < n; i++) at(i, j) -= 2 * dot / uu * u[i];
    }
  }
  std::vector<double> x(n);
  for (size_t k = n; k-- > 0;) {
    x[k] = at(k, n);
    for (size_t j = k + 1; j < n; j++) x[k] -= at(k, j) * x[j];
    x[k] /= at(k, k);
  }
  return x;
}
