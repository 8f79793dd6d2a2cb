// The displacement is the unknown, and the equations contain only particles that move: (M / h^2 + c I / h - J) dx = M v
// / h + springs + gravity.
#include <cmath>

#include "stiff.h"

State implicit_euler_step(const System& system, const State& state, double h) {
  std::vector<int> place(state.x.size(), -1);
  int unknowns = 0;
  for (size_t i = 0; i < place.size(); i++)
    if (!system.fixed[i]) {
      place[i] = unknowns;
      unknowns += 3;
    }
  Matrix k(unknowns, Vector(unknowns, 0.0));
  Vector f(unknowns, 0.0);
  for (size_t i = 0; i < place.size(); i++)
    for (int c = 0; place[i] >= 0 && c < 3; c++) {
      k[place[i] + c][place[i] + c] += system.mass[i] / h / h + system.drag / h;
      f[place[i] + c] += system.mass[i] * (state.v[i][c] / h + system.gravity[c]);
    }
  for (const Spring& s : system.springs) {
    const int ends[2] = {place[s.a], place[s.b]};
    Vec3 d;
    double r2 = 0;
    for (int c = 0; c < 3; c++) {
      d[c] = state.x[s.a][c] - state.x[s.b][c];
      r2 += d[c] * d[c];
    }
    const double over = r2 > 0 ? s.stiffness * (1 - s.rest / std::sqrt(r2)) : 0;
    const Matrix3 j = spring_jacobian(d, s.stiffness, s.rest);
    for (int e = 0; e < 2; e++)
      for (int r = 0; ends[e] >= 0 && r < 3; r++) {
        f[ends[e] + r] += (e == 0 ? -1 : 1) * over * d[r];
        for (int c = 0; c < 3; c++) {
          k[ends[e] + r][ends[e] + c] -= j[r][c];
          if (ends[1 - e] >= 0) k[ends[e] + r][ends[1 - e] + c] += j[r][c];
        }
      }
  }
  const Vector dx = solve(k, f);
  State next = state;
  for (size_t i = 0; i < place.size(); i++)
    for (int c = 0; place[i] >= 0 && c < 3; c++) {
      next.x[i][c] += dx[place[i] + c];
      next.v[i][c] = dx[place[i] + c] / h;
    }
  return next;
}
