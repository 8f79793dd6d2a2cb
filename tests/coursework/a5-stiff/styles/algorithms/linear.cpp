// Gauss-Jordan elimination with the largest of all entries as pivot; columns are renumbered, not moved.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "stiff.h"

Vector solve(Matrix a, Vector b) {
  const std::size_t n = b.size();
  std::vector<std::size_t> rows(n), unknown_of(n);
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  std::vector<bool> used(n, false);
  double first = 0;
  for (std::size_t done = 0; done < n; ++done) {
    std::size_t best_row = n, best_column = 0;
    double best = -1;
    for (std::size_t i : rows)
      for (std::size_t j = 0; j < n; ++j)
        if (!used[j] && std::fabs(a[i][j]) > best) best = std::fabs(a[i][j]), best_row = i, best_column = j;
    if (done == 0) first = best;
    if (best <= 1e-12 * first) throw std::domain_error("the rows depend on each other");
    rows.erase(std::find(rows.begin(), rows.end(), best_row));
    used[best_column] = true;
    unknown_of[best_row] = best_column;
    const double pivot = a[best_row][best_column];
    for (double& entry : a[best_row]) entry /= pivot;
    b[best_row] /= pivot;
    for (std::size_t i = 0; i < n; ++i) {
      if (i == best_row) continue;
      const double factor = a[i][best_column];
      for (std::size_t j = 0; j < n; ++j) a[i][j] -= factor * a[best_row][j];
      b[i] -= factor * b[best_row];
    }
  }
  Vector x(n);
  for (std::size_t i = 0; i < n; ++i) x[unknown_of[i]] = b[i];
  return x;
}
