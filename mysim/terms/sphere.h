// Spheres with Coulomb friction and restitution, at rest or in a prescribed motion. They are no force: each acts on the
// whole step of a particle. What follows is seen from the sphere: positions and velocities are relative to it.
//
// The stepper proposes x* and v*. If |x* - centre| < R (R = radius + margin), then
//   1. position: the particle is put on the surface, which pushes it by p along the outward normal n;
//   2. friction on the position: its tangential displacement in the step, seen from x_n, is reduced by at most mu p
//      (Coulomb: tangential impulse at most mu times the normal one), and the result is put on the surface again;
//   3. velocity: the inward normal part is removed (or reversed times e), and the tangential part is reduced by at most
//      mu times the change of the normal part.
// Friction on the velocity alone is not enough: a particle at rest on a slope would creep at about h g sin(theta) / 2.
#pragma once

#include <algorithm>
#include <optional>
#include <string_view>
#include <vector>

#include "mysim/particles.h"

namespace crosscheck {

struct Sphere {
  Vec3 centre;         // m, at t = 0
  double radius;       // m, of the solid ball
  double margin;       // m, half the thickness of the cloth: particles stay at radius + margin from the centre
  double friction;     // Coulomb's mu, 1
  double restitution;  // e, 0 to 1
  std::optional<Motion> motion;

  double contact_radius() const { return radius + margin; }
  Vec3 centre_at(double t) const { return motion ? Vec3(centre + displacement_at(*motion, t)) : centre; }  // m
};

struct Spheres {
  static constexpr std::string_view name = "sphere";
  std::vector<Sphere> list;

  bool moving() const {
    return std::any_of(list.begin(), list.end(), [](const Sphere& s) { return s.motion.has_value(); });
  }
};

/// Distance of a particle from the nearest contact surface at time t, m; negative inside.
double clearance_from(const Spheres& spheres, double t, const Vec3& x);

/// Applies the rule above to one particle that was at x_n, with the sphere at `centre`, in the sphere's frame. Returns
/// the push p (m); 0 when there was no contact.
double resolve_contact(const Sphere& sphere, const Vec3& centre, const Vec3& x_n, Eigen::Ref<Vec3> x,
                       Eigen::Ref<Vec3> v);

/// The assignment's sphere, kept to be shown failing: a particle that touches is put back to where it came from, on the
/// surface, and loses all its velocity: it freezes to the sphere. Returns the push p (m); 0 when there was no contact.
double resolve_contact_sticky(const Sphere& sphere, const Vec3& centre, const Vec3& x_n, Eigen::Ref<Vec3> x,
                              Eigen::Ref<Vec3> v);

}  // namespace crosscheck
