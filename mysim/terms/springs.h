// Springs. With d = x_a - x_b and L = |d|, the force on a is -T(L) d / L, and the opposite on b. The law T is
//   hooke         T = k (L - r), energy k (L - r)^2 / 2;
//   bullet-link   T = k L (L^2 - r^2) / (L^2 + r^2), energy k/2 (L^2 - r^2 - 2 r^2 ln((L^2 + r^2) / (2 r^2))).
// bullet-link is the limit of Bullet's position-based links for steps h -> 0: the correction in a step, over h^2.
#pragma once

#include <cmath>
#include <string_view>
#include <vector>

#include "mysim/forces.h"
#include "mysim/particles.h"

namespace crosscheck {

enum class Family { single, structural, shear, bend };
std::string_view name_of(Family family);

struct Spring {
  int a, b;
  double k;       // stiffness, N/m
  double rest;    // rest length r, m
  Family family;  // for colours, tables and ablations only
};

enum class SpringLaw { hooke, bullet_link };
std::string_view name_of(SpringLaw law);  // as in scene files

struct Springs {
  static constexpr std::string_view name = "springs";
  std::vector<Spring> list;
  SpringLaw law = SpringLaw::hooke;
};

/// Tension T(L) (N; positive: pulls) and its slope dT/dL (N/m), at length L > 0 (m).
struct Tension {
  double force, slope;
};
Tension tension_of(const Spring& spring, SpringLaw law, double length);

/// -T / L (N/m) at squared length L^2 > 0 (m^2).
template <SpringLaw law>
double force_over_length(double k, double rest, double squared) {
  if constexpr (law == SpringLaw::hooke) {
    const double length = std::sqrt(squared);
    return k * (rest - length) / length;
  }
  const double r2 = rest * rest;
  return k * (r2 - squared) / (squared + r2);
}

/// The plain edge loop: defines the term, and is the reference for every faster kernel
/// (mysim/simd/spring_graph/spring_kernel.h).
void add_force(const Springs& springs, const Particles& particles, const State& state, Forces& forces);
void add_force(const Springs& springs, const Points& x, Forces& forces);
double potential_energy(const Springs& springs, const Particles& particles, const State& state);  // J
/// -dF/dx. If clamped, omits the negative transverse stiffness of compressed springs, which makes the matrix positive
/// semidefinite.
void add_tangent(const Springs& springs, const Particles& particles, const State& state, Curvature curvature,
                 Tangent& tangent);

}  // namespace crosscheck
