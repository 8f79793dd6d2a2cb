// Gaussian elimination with partial pivoting.
#include <cmath>
#include <stdexcept>
#include <utility>

#include "stiff.h"

Vector solve(Matrix a, Vector b) {
  const int n = static_cast<int>(b.size());
  double largest = 0;
  for (const Vector& row : a)
    for (const double entry : row) largest = std::max(largest, std::abs(entry));

  for (int k = 0; k < n; ++k) {
    int pivot = k;
    for (int i = k + 1; i < n; ++i)
      if (std::abs(a[i][k]) > std::abs(a[pivot][k])) pivot = i;
    std::swap(a[k], a[pivot]);
    std::swap(b[k], b[pivot]);
    if (std::abs(a[k][k]) <= 1e-12 * largest) throw std::domain_error("singular matrix");
    for (int i = k + 1; i < n; ++i) {
      const double factor = a[i][k] / a[k][k];
      for (int j = k; j < n; ++j) a[i][j] -= factor * a[k][j];
      b[i] -= factor * b[k];
    }
  }

  for (int k = n - 1; k >= 0; --k) {
    for (int j = k + 1; j < n; ++j) b[k] -= a[k][j] * b[j];
    b[k] /= a[k][k];
  }
  return b;
}
