// The matrix by columns: the change of the force when d changes along x, y, z.
#include <cmath>

#include "stiff.h"

Matrix3 spring_jacobian(const Vec3& d, double stiffness, double rest) {
  const auto [x, y, z] = d;
  const double r2 = x * x + y * y + z * z;
  if (r2 == 0.) return Matrix3{};
  const double f = stiffness * (1. - rest / std::sqrt(r2));   // the force is -f d
  const double df = stiffness * rest / (r2 * std::sqrt(r2));  // df/dx is df * x
  return Matrix3{Vec3{-f - df * x * x, -df * x * y, -df * x * z}, Vec3{-df * y * x, -f - df * y * y, -df * y * z},
                 Vec3{-df * z * x, -df * z * y, -f - df * z * z}};
}
