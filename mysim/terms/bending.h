// Bending of a sheet that is flat at rest, with rigidity B (N m) and Poisson's ratio 0.
//
// A thin plate stores the energy B/2 (w_uu^2 + 2 w_uv^2 + w_vv^2) per area, where w is its deflection (S. Timoshenko
// and S. Woinowsky-Krieger, Theory of Plates and Shells, chapter 4; Poisson's ratio enters only through w_uu w_vv -
// w_uv^2). In an inextensible sheet, however far it bends, |x_uu|, |x_uv| and |x_vv| take the place of the derivatives
// of w, where x is the position in space (M. Bergou et al., A quadratic bending model for inextensible surfaces, SGP
// 2006). The energy is then quadratic in x. On a grid with spacings p and q along u and v
//   x_uu = (x_{i-1} - 2 x_i + x_{i+1}) / p^2 + O(p^2)         on an area p q, half of that on an edge row
//   x_uv = (x_00 - x_10 - x_01 + x_11) / (p q) + O(p^2 + q^2) on the area p q of a cell
// and x_vv likewise.
// The energy is a sum of k/2 |c|^2, c = sum_i w_i x_i, over stencils of particles i with weights w_i:
//   (1, -2, 1) along u with k = B q / p^3, along v with B p / q^3, half of it on edge rows
//   (1, -1, -1, 1) with k = 2 B / (p q).
// The force on particle i is -k w_i c, and -dF_i/dx_j = k w_i w_j, constant and positive semidefinite. Since the
// weights sum to zero, |c|^2 = - sum_{i<j} w_i w_j |x_i - x_j|^2: a stencil is equivalent to springs of zero rest
// length and stiffness -k w_i w_j, some of it negative. Therefore momentum and angular momentum are conserved.
//
// Let s be the arc length along a row. Pins at s = -p/2 and p/2 at the same height clamp the row horizontally at s = 0,
// and the error of its shape then decreases as p^2.
#pragma once

#include <array>
#include <vector>

#include "mysim/forces.h"
#include "mysim/particles.h"

namespace crosscheck {

struct Bending {
  static constexpr std::string_view name = "bending";
  static constexpr int most = 5;  // particles in a stencil: up to four on a grid, five on a sheet of rings
  struct Stencil {
    int size;
    std::array<int, most> particle;   // the first `size` entries of both arrays are used
    std::array<double, most> weight;  // dimensionless; they sum to 0
    double k;                         // N/m
  };
  std::vector<Stencil> list;
  double rigidity;  // B, N m, of the sheet; informative only
};

/// c of a stencil (m).
inline Vec3 bent(const Bending::Stencil& s, const Points& x) {
  Vec3 c = Vec3::Zero();
  for (int i = 0; i < s.size; ++i) c += s.weight[i] * x.col(s.particle[i]);
  return c;
}

inline void add_force(const Bending& bending, const Particles&, const State& state, Forces& forces) {
  for (const Bending::Stencil& s : bending.list) {
    const Vec3 f = -s.k * bent(s, state.x);
    for (int i = 0; i < s.size; ++i) forces.f.col(s.particle[i]) += s.weight[i] * f;
  }
}

inline double potential_energy(const Bending& bending, const Particles&, const State& state) {
  double energy = 0;
  for (const Bending::Stencil& s : bending.list) energy += 0.5 * s.k * bent(s, state.x).squaredNorm();
  return energy;
}

/// Calls visit(a, b, k) for each zero-length spring equivalent to the stencils (k in N/m).
template <class Visit>
void for_each_pair(const Bending& bending, Visit visit) {
  for (const Bending::Stencil& s : bending.list)
    for (int i = 0; i < s.size; ++i)
      for (int j = 0; j < i; ++j) visit(s.particle[i], s.particle[j], -s.k * s.weight[i] * s.weight[j]);
}

/// -dF/dx, the same in every state.
inline void add_tangent(const Bending& bending, const Particles&, const State&, Curvature, Tangent& tangent) {
  for_each_pair(bending, [&](int a, int b, double k) { tangent.add_stiffness({a, b, Vec3::UnitX(), k, k}); });
}

}  // namespace crosscheck
