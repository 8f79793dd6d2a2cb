// dF/dx = -k (n n^T + (1 - r/L) (I - n n^T)): the stiffness is k along the spring, and tension / length across it.
#include <cmath>

#include "stiff.h"

Matrix3 spring_jacobian(const Vec3& d, double stiffness, double rest) {
  Matrix3 j{};
  const double length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
  if (length == 0) return j;
  const Vec3 n = {d[0] / length, d[1] / length, d[2] / length};
  const double across = 1 - rest / length;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column) {
      const double along = n[row] * n[column];
      const double beside = (row == column ? 1 : 0) - along;
      j[row][column] = -stiffness * (along + across * beside);
    }
  return j;
}
