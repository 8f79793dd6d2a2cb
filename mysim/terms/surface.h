// Surfaces with Coulomb friction and restitution: spheres and planes, fixed or in prescribed motion. They are not
// forces: each acts on the whole step of a particle. Below, positions and velocities are relative to the surface.
//
// The stepper proposes x* and v*. If the gap of x* is negative (|x* - centre| < R, or (x* - point) . normal < 0, margin
// included):
//   1. position: the particle is put on the surface, which pushes it by p along the outward normal n;
//   2. friction on the position: the particle's tangential displacement from x_n is reduced by at most mu p
//      (Coulomb: tangential impulse at most mu times the normal one), and the result is put on the surface again;
//   3. velocity: the inward normal component is removed (or reversed times e), and the tangential component is reduced
//      by at most mu times the change of the normal component.
// Friction on the velocity alone does not suffice: a particle at rest on a slope would creep at about h g sin(theta) /
// 2.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "mysim/particles.h"

namespace crosscheck {

struct Sphere {
  Vec3 centre;         // m, at t = 0
  double radius;       // m, of the ball
  double margin;       // m, half the cloth's thickness: particles stay at radius + margin from the centre
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

/// A solid half-space, fixed or translating.
struct Plane {
  Vec3 point;                    // m, on the face, at t = 0
  Vec3 normal;                   // unit vector out of the solid
  double margin;                 // m, half the cloth's thickness: particles stay at this distance from the face
  double friction;               // Coulomb's mu, 1
  double restitution;            // e, 0 to 1
  std::optional<Vec3> velocity;  // m/s, constant

  Vec3 point_at(double t) const { return velocity ? Vec3(point + t * *velocity) : point; }  // m
};

struct Planes {
  static constexpr std::string_view name = "plane";
  std::vector<Plane> list;

  bool moving() const {
    return std::any_of(list.begin(), list.end(), [](const Plane& p) { return p.velocity.has_value(); });
  }
};

/// The contact surface of a sphere or a plane, margin included, as the contact rules see it. Positions are relative to
/// its origin: the sphere's centre, or a point of the contact plane.
class Surface {
 public:
  Surface(const Sphere& s)  // NOLINT(google-explicit-constructor): a sphere is a surface
      : friction(s.friction),
        restitution(s.restitution),
        origin_(s.centre),
        radius_(s.contact_radius()),
        motion_(s.motion) {}
  Surface(const Plane& p)  // NOLINT(google-explicit-constructor)
      : friction(p.friction),
        restitution(p.restitution),
        origin_(p.point + p.margin * p.normal),
        radius_(std::numeric_limits<double>::infinity()),
        normal_(p.normal),
        drift_(p.velocity) {}

  double friction, restitution;  // mu, e

  bool flat() const { return std::isinf(radius_); }
  double radius() const { return radius_; }  // m; infinite for a plane
  bool moving() const { return motion_ || drift_; }
  Vec3 origin_at(double t) const {
    if (motion_) return origin_ + displacement_at(*motion_, t);
    return drift_ ? Vec3(origin_ + t * *drift_) : origin_;
  }
  Vec3 velocity_at(double t) const {  // m/s
    return motion_ ? crosscheck::velocity_at(*motion_, t) : drift_.value_or(Vec3::Zero());
  }
  double max_speed() const { return motion_ ? crosscheck::max_speed(*motion_) : drift_ ? drift_->norm() : 0; }  // m/s

  double gap(const Vec3& d) const { return flat() ? d.dot(normal_) : d.norm() - radius_; }  // m, negative inside
  /// Outward unit normal at d; (0, 1, 0) at the centre of a sphere.
  Vec3 normal(const Vec3& d) const {
    if (flat()) return normal_;
    const double length = d.norm();
    return length > 0 ? Vec3(d / length) : Vec3(0, 1, 0);
  }
  /// Normal at d on the surface; needs no square root.
  Vec3 normal_on(const Vec3& d) const { return flat() ? normal_ : Vec3(d / radius_); }
  /// Rate of change of the gap at d with relative velocity w, times a positive number.
  double approach(const Vec3& d, const Vec3& w) const { return flat() ? w.dot(normal_) : d.dot(w); }
  /// Point on the surface nearest to d, where n is the normal.
  Vec3 nearest(const Vec3& d, const Vec3& n) const { return flat() ? Vec3(d - d.dot(n) * n) : Vec3(radius_ * n); }
  /// x projected onto the surface whose origin is at `origin`; n is the normal there. If x is already on a plane, up to
  /// rounding, its coordinates along the plane do not change.
  Vec3 put_on(const Vec3& origin, const Vec3& x, const Vec3& n) const {
    return flat() ? Vec3(x - (x - origin).dot(n) * n) : Vec3(origin + radius_ * n);
  }
  /// Length (m) relative to which a gap is rounded; `reach`: distance of the particle from the coordinate origin.
  double rounding_scale(const Vec3& origin, double reach) const { return (flat() ? reach : radius_) + origin.norm(); }

 private:
  Vec3 origin_;
  double radius_;
  Vec3 normal_ = Vec3::Zero();  // planes only
  std::optional<Motion> motion_;
  std::optional<Vec3> drift_;
};

/// Distance (m) from the nearest contact surface at time t; negative inside.
double clearance_from(std::span<const Surface> surfaces, double t, const Vec3& x);

/// Applies the rule above to one particle that was at x_n in the frame of the surface, whose origin is at `origin`.
/// Returns the push p (m), or 0 without contact.
double resolve_contact(const Surface& surface, const Vec3& origin, const Vec3& x_n, Eigen::Ref<Vec3> x,
                       Eigen::Ref<Vec3> v);

/// The assignment's sphere, kept to demonstrate its failure: a touching particle is put on the surface at its previous
/// position and loses its velocity, so it freezes there. Returns the push p (m), or 0 without contact.
double resolve_contact_sticky(const Surface& surface, const Vec3& origin, const Vec3& x_n, Eigen::Ref<Vec3> x,
                              Eigen::Ref<Vec3> v);

}  // namespace crosscheck
