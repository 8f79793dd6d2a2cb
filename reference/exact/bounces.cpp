// Particles that fall straight on balls: parabolas between impacts.
#include <cmath>
#include <limits>

#include "reference/exact/recognise.h"

namespace crosscheck {
namespace {

/// Height over the surface and upward speed.
struct Flight {
  double height, speed;  // m, m/s
};

/// After time t (s) of falling and bouncing under g (m/s^2) with restitution e; speeds are reversed times e at height
/// 0.
Flight bounced(Flight f, double g, double e, double t) {
  for (;;) {
    const double impact = std::sqrt(f.speed * f.speed + 2 * g * f.height);  // m/s, downwards
    const double flight = (f.speed + impact) / g;
    if (t <= flight) return {f.height + t * (f.speed - g * t / 2), f.speed - g * t};
    t -= flight;
    f = {0, e * impact};
    // all later bounces together take 2 v / (g (1 - e)): then it lies still
    if (e < 1 && t >= 2 * f.speed / (g * (1 - e)) * (1 - 1e-15)) return {0, 0};
  }
}

}  // namespace

std::optional<ExactSolution> bounces(const Scene& scene) {
  const Model& model = scene.model;
  const auto* gravity = model.find<Gravity>();
  const auto* spheres = model.find<Spheres>();
  if (!gravity || !spheres || !only<Gravity, Spheres>(model) || !model.particles.pins.empty() || spheres->moving())
    return std::nullopt;
  const double g = gravity->acceleration.norm();
  if (!(g > 0)) return std::nullopt;
  const Vec3 up = -gravity->acceleration / g;

  struct Drop {
    Flight start;
    double restitution;
  };
  std::vector<Drop> drops;
  for (int i = 0; i < model.particles.size(); ++i) {
    const Vec3 x = scene.start.x.col(i), v = scene.start.v.col(i);
    if ((v - v.dot(up) * up).norm() > 0) return std::nullopt;
    const Sphere* below = nullptr;
    double gap = std::numeric_limits<double>::infinity();
    for (const Sphere& s : spheres->list) {
      const Vec3 d = x - s.centre;
      const double aside = (d - d.dot(up) * up).norm();
      if (aside >= s.contact_radius()) continue;                    // falls past it
      if (aside > 1e-15 * s.contact_radius()) return std::nullopt;  // is thrown aside
      if (d.dot(up) > 0 && d.dot(up) - s.contact_radius() < gap) below = &s, gap = d.dot(up) - s.contact_radius();
      if (d.dot(up) < 0) return std::nullopt;  // one above: it could fly against it
    }
    if (!below) return std::nullopt;
    drops.push_back({{std::max(0.0, gap), v.dot(up)}, below->restitution});
  }
  return ExactSolution{"parabolas between impacts that return the restitution's part of the speed",
                       [start = scene.start, up, g, drops](double t) {
                         State s = start;
                         s.t = t;
                         for (size_t i = 0; i < drops.size(); ++i) {
                           const int at = static_cast<int>(i);
                           const Flight f = bounced(drops[i].start, g, drops[i].restitution, t);
                           s.x.col(at) += (f.height - drops[i].start.height) * up;
                           s.v.col(at) = f.speed * up;
                         }
                         return s;
                       }};
}

}  // namespace crosscheck
