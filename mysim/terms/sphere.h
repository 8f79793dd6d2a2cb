// A fixed sphere with Coulomb friction and restitution. It is no force: it acts on the whole step of a particle.
//
// The stepper proposes x* and v*. If |x* - centre| < R (R = radius + margin), then
//   1. position: the particle is put on the surface, which pushes it by p along the outward normal n;
//   2. friction on the position: its tangential displacement in the step, seen from x_n, is reduced by at most mu p
//      (Coulomb: tangential impulse at most mu times the normal one), and the result is put on the surface again;
//   3. velocity: the inward normal part is removed (or reversed times e), and the tangential part is reduced by at most
//      mu times the change of the normal part.
// Friction on the velocity alone is not enough: a particle at rest on a slope would creep at about h g sin(theta) / 2.
#pragma once

#include <string_view>

#include "mysim/section.h"

namespace crosscheck {

struct Sphere {
  static constexpr std::string_view name = "sphere";
  Vec3 centre;         // m
  double radius;       // m, of the solid ball
  double margin;       // m, half the thickness of the cloth: particles stay at radius + margin from the centre
  double friction;     // Coulomb's mu, 1
  double restitution;  // e, 0 to 1

  double contact_radius() const { return radius + margin; }
};

Sphere read_sphere(const Section& s);

/// Applies the rule above to one particle that was at x_n. Returns the push p (m); 0 when there was no contact.
double resolve_contact(const Sphere& sphere, const Vec3& x_n, Eigen::Ref<Vec3> x, Eigen::Ref<Vec3> v);

/// The assignment's sphere, kept to be shown failing: a particle that touches is put back to where it came from, on the
/// surface, and loses all its velocity: it freezes to the sphere. Returns the push p (m); 0 when there was no contact.
double resolve_contact_sticky(const Sphere& sphere, const Vec3& x_n, Eigen::Ref<Vec3> x, Eigen::Ref<Vec3> v);

}  // namespace crosscheck
