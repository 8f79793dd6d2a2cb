// (M + h c I - h^2 J) dv = h (F + h J v), then v' = v + dv and x' = x + h v'.
#include <cmath>

#include "stiff.h"

namespace {

struct Equations {
  Matrix a;
  Vector b;
};

void add_spring(Equations& e, const Spring& spring, const State& state, double h) {
  Vec3 d, w;
  for (int c = 0; c < 3; ++c) {
    d[c] = state.x[spring.a][c] - state.x[spring.b][c];
    w[c] = state.v[spring.a][c] - state.v[spring.b][c];
  }
  const double length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
  const double pull = length > 0 ? spring.stiffness * (length - spring.rest) / length : 0;
  const Matrix3 j = spring_jacobian(d, spring.stiffness, spring.rest);
  const int a = 3 * spring.a, b = 3 * spring.b;
  for (int row = 0; row < 3; ++row) {
    double force = -pull * d[row];
    for (int c = 0; c < 3; ++c) force += h * j[row][c] * w[c];
    e.b[a + row] += h * force;
    e.b[b + row] -= h * force;
    for (int c = 0; c < 3; ++c) {
      const double block = h * h * j[row][c];
      e.a[a + row][a + c] -= block;
      e.a[b + row][b + c] -= block;
      e.a[a + row][b + c] += block;
      e.a[b + row][a + c] += block;
    }
  }
}

}  // namespace

State implicit_euler_step(const System& system, const State& state, double h) {
  const int n = static_cast<int>(state.x.size());
  Equations e{Matrix(3 * n, Vector(3 * n, 0.0)), Vector(3 * n, 0.0)};
  for (int i = 0; i < 3 * n; ++i) {
    const double mass = system.mass[i / 3];
    const double drag = -system.drag * state.v[i / 3][i % 3];
    e.a[i][i] = mass + h * system.drag;
    e.b[i] = h * (mass * system.gravity[i % 3] + drag);
  }
  for (const Spring& spring : system.springs) add_spring(e, spring, state, h);

  for (int i = 0; i < 3 * n; ++i) {
    if (!system.fixed[i / 3]) continue;
    e.a[i].assign(3 * n, 0.0);
    e.a[i][i] = 1;
    e.b[i] = 0;
  }

  const Vector dv = solve(e.a, e.b);
  State next = state;
  for (int i = 0; i < 3 * n; ++i) {
    double& v = next.v[i / 3][i % 3];
    v += dv[i];
    next.x[i / 3][i % 3] += h * v;
  }
  return next;
}
