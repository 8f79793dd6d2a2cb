// Second-order contact with spheres and planes: locates touching, leaving and stopping within the step.
//
// A stepper moves a particle from x_n, v_n to x*, v* as if there were no surface. Let b be the mean acceleration of
// that step without drag,
//   b = (v* - v_n) / h + gamma (v_n + v*) / 2,
// held constant. The particle repeats the step in the frame of the surface, whose acceleration is subtracted:
//   free     dw/ds = b - gamma w, until the first root of the gap. On impact, the inward speed w_n is reversed,
//            times e, and the tangential speed is reduced by at most mu (1 + e) |w_n|. A rebound that would return
//            within a step is suppressed (e = 0): an endless sequence of bounces ends in contact.
//   slides   dw/ds = b - gamma w + N n - mu N w/|w|, with N = -b.n - |w|^2 / R (R infinite for a plane), by the
//            midpoint rule, projected back onto the surface. Ends at the root of N, where the particle leaves, or of
//            w, where it stops.
//   sticks   as long as |b_t| <= mu N.
// The impulses of several surfaces that touch a particle are computed together for the rest of the step, by projected
// Gauss-Seidel iteration (J. J. Moreau, Unilateral contact and dry friction in finite freedom dynamics, 1988; M. Jean,
// Comput. Methods Appl. Mech. Engrg. 177, 1999).
//
// The order is 2, although b is wrong: by O(h^2) during a lasting contact, which displaces the particle by h^2 N / 2
// within a step, and by O(h) at an impact, but only in that step. No additional acceleration is evaluated. Dashpots and
// air depend on speeds, which contact changes by h N after the evaluation, so with these terms the order is 1. On a
// moving sphere with friction a particle sticks and slips, and a slow slide turns towards the force within |w| / (mu
// N), which is less than a step. The order measured from two step sizes then varies from -0.8 to 5.7. Only the trend
// over 21 step sizes from 13 to 0.4 ms shows order 2: 1.7 to 2.3 (mu 0.03 to 0.28 on a ball of 1 m, three motions).
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "mysim/terms/surface.h"

namespace crosscheck {

/// Motion of a surface during one step: a cubic through both positions, with linear interpolation of the velocity.
class SurfaceTrack {
 public:
  SurfaceTrack(const Surface& surface, double t_n, double t);
  const Surface& surface() const { return *surface_; }
  /// State at time s within the step, 0 <= s <= h (m, m/s); exact at both ends.
  Vec3 origin(double s) const;
  Vec3 velocity(double s) const;
  const Vec3& acceleration() const { return acceleration_; }  // m/s^2

 private:
  const Surface* surface_;
  double h_;
  Vec3 origin_, velocity_, end_origin_, end_velocity_, acceleration_, rest_;
};

/// The surfaces must outlive the tracks.
std::vector<SurfaceTrack> surface_tracks(std::span<const Surface> surfaces, double t_n, double t);

/// Advances a particle with drag rate gamma (1/s) through a step h (s) as described above. x and v are x* and v* on
/// entry, and the end of the step on return. Returns the energy lost in contacts (J/kg, contacts.h), or nothing, with x
/// and v unchanged, if no surface was touched.
std::optional<double> resolve_events(std::span<const SurfaceTrack> surfaces, double h, double gamma, const Vec3& x_n,
                                     const Vec3& v_n, Eigen::Ref<Vec3> x, Eigen::Ref<Vec3> v);

}  // namespace crosscheck
