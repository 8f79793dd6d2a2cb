// Derivative of the force -k d + k r d / |d|, term by term: -k I + k r (I / L - d d^T / L^3).
#include <algorithm>
#include <cmath>
#include <numeric>

#include "stiff.h"

Matrix3 spring_jacobian(const Vec3& d, double stiffness, double rest) {
  const double squared = std::inner_product(d.begin(), d.end(), d.begin(), 0.0);
  Matrix3 j = {};
  if (!(squared > 0)) return j;
  const double per_length = stiffness * rest / std::sqrt(squared);
  for (std::size_t row = 0; row < 3; ++row) {
    std::transform(d.begin(), d.end(), j[row].begin(),
                   [&](double part) { return -per_length * d[row] * part / squared; });
    j[row][row] += per_length - stiffness;
  }
  return j;
}
