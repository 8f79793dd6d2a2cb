// Particles that friction holds on balls: they stay where they are.
#include "reference/exact/recognise.h"

namespace crosscheck {

std::optional<ExactSolution> friction_hold(const Scene& scene) {
  const Model& model = scene.model;
  const auto* spheres = model.find<Spheres>();
  const auto a = steady_acceleration(model);
  if (!spheres || !a || !(a->norm() > 0) || !only<Gravity, Wind, Drag, Spheres>(model) || spheres->moving() ||
      !model.particles.pins.empty() || !scene.start.v.isZero(0))
    return std::nullopt;
  for (int i = 0; i < model.particles.size(); ++i) {
    const Sphere* under = nullptr;
    Vec3 n;
    for (const Sphere& s : spheres->list) {
      const Vec3 d = scene.start.x.col(i) - s.centre;
      const double gap = d.norm() - s.contact_radius();
      if (gap > 1e-12 * s.contact_radius()) continue;
      if (under) return std::nullopt;  // wedged between two: that asks for both forces at once
      under = &s, n = d.normalized();
    }
    if (!under) return std::nullopt;
    // Coulomb's cone: what acts along the surface is less than mu times what presses on it
    const double pressing = -a->dot(n), along = (*a + pressing * n).norm();
    if (!(along < under->friction * pressing || (along == 0 && pressing > 0))) return std::nullopt;
  }
  return ExactSolution{"friction holds every particle: it stays", [start = scene.start](double t) {
                         State s = start;
                         s.t = t;
                         return s;
                       }};
}

}  // namespace crosscheck
