// The new velocity is the unknown: (M + h c I - h^2 J) v' = M v + h (springs + gravity). The force at x + h v' is the
// current force plus h J v', so that J v cancels.
#include <cmath>
#include <tuple>

#include "stiff.h"

State implicit_euler_step(const System& s, const State& now, double h) {
  const size_t n = now.x.size();
  Matrix lhs(3 * n, Vector(3 * n));
  Vector rhs(3 * n);
  for (size_t i = 0; i != n; ++i)
    for (size_t c = 0; c != 3; ++c) {
      lhs[3 * i + c][3 * i + c] = s.mass[i] + h * s.drag;
      rhs[3 * i + c] = s.mass[i] * (now.v[i][c] + h * s.gravity[c]);
    }
  for (const Spring& spring : s.springs) {
    Vec3 d{};
    for (size_t c = 0; c != 3; ++c) d[c] = now.x[spring.a][c] - now.x[spring.b][c];
    const double length = std::hypot(d[0], d[1], d[2]);
    const Matrix3 j = spring_jacobian(d, spring.stiffness, spring.rest);
    for (const auto& [to, other, sign] :
         {std::make_tuple(spring.a, spring.b, 1.0), std::make_tuple(spring.b, spring.a, -1.0)})
      for (size_t r = 0; r != 3; ++r) {
        if (length > 0) rhs[3 * to + r] -= sign * h * spring.stiffness * (length - spring.rest) * d[r] / length;
        for (size_t c = 0; c != 3; ++c) {
          lhs[3 * to + r][3 * to + c] -= h * h * j[r][c];
          lhs[3 * to + r][3 * other + c] += h * h * j[r][c];
        }
      }
  }
  for (size_t i = 0; i != n; ++i)
    for (size_t c = 0; s.fixed[i] && c != 3; ++c) {
      lhs[3 * i + c] = Vector(3 * n);
      lhs[3 * i + c][3 * i + c] = 1;
      rhs[3 * i + c] = 0;
    }
  const Vector v = solve(lhs, rhs);
  State then = now;
  for (size_t i = 0; i != n; ++i)
    for (size_t c = 0; !s.fixed[i] && c != 3; ++c) {
      then.v[i][c] = v[3 * i + c];
      then.x[i][c] = now.x[i][c] + h * v[3 * i + c];
    }
  return then;
}
