#include "mysim/terms/aerodynamics.h"

#include <Eigen/Geometry>

namespace crosscheck {

void add_force(const Aerodynamics& air, const Particles&, const State& state, Forces& forces) {
  const Vec3 wind = air.velocity.at(state.t);
  for (const auto& [a, b, c] : air.triangles) {
    const Vec3 area = 0.5 * Vec3(state.x.col(b) - state.x.col(a)).cross(Vec3(state.x.col(c) - state.x.col(a)));
    const double size = area.norm();
    if (size == 0) continue;
    const Vec3 u = wind - (state.v.col(a) + state.v.col(b) + state.v.col(c)) / 3;
    const Vec3 third = (air.density * air.coefficient * u.norm() * u.dot(area) / (6 * size)) * area;
    forces.f.col(a) += third;
    forces.f.col(b) += third;
    forces.f.col(c) += third;
  }
}

}  // namespace crosscheck
