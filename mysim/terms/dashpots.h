// Spring dashpots along the line between two particles: with the unit vector n from b to a, the force on a is -c ((v_a
// - v_b) . n) n, and the opposite on b. They damp stretching, but neither free fall nor rotation.
#pragma once

#include <vector>

#include "mysim/forces.h"
#include "mysim/particles.h"

namespace crosscheck {

struct Dashpots {
  static constexpr std::string_view name = "dashpots";
  static constexpr bool uses_velocity = true;
  struct Dashpot {
    int a, b;
    double c;  // N s/m
  };
  std::vector<Dashpot> list;
};

inline void add_force(const Dashpots& dashpots, const Particles&, const State& state, Forces& forces) {
  for (const auto& [a, b, c] : dashpots.list) {
    const Vec3 d = state.x.col(a) - state.x.col(b);
    const double length2 = d.squaredNorm();
    if (length2 == 0) continue;  // coincident ends have no direction and no force; their spring counts this case
    const Vec3 f = (-c * (state.v.col(a) - state.v.col(b)).dot(d) / length2) * d;
    forces.f.col(a) += f;
    forces.f.col(b) -= f;
  }
}

/// -dF/dv at the state's directions. The change of the directions (dF/dx) is omitted, which keeps the matrix symmetric.
/// Instead, implicit methods repeat the solve with the new directions.
inline void add_tangent(const Dashpots& dashpots, const Particles&, const State& state, Curvature, Tangent& tangent) {
  for (const auto& [a, b, c] : dashpots.list) {
    const Vec3 d = state.x.col(a) - state.x.col(b);
    const double length = d.norm();
    if (length > 0) tangent.add_damping({a, b, d / length, c, 0});
  }
}

}  // namespace crosscheck
