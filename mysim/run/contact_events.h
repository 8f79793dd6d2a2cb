// Contact with spheres and planes to second order: where a particle touches, leaves and stops is located within the
// step.
//
// A stepper takes a particle from x_n, v_n to x*, v* as if there were no surface. With the mean acceleration of that
// step, the drag left out,
//   b = (v* - v_n) / h + gamma (v_n + v*) / 2,
// held constant, the particle goes through the step again, seen from the surface (whose own acceleration is
// subtracted):
//   free     dw/ds = b - gamma w, up to the first root of the gap; there it hits: the inward speed w_n is reversed
//            times e, and the tangential one reduced by at most mu (1 + e) |w_n|. A rebound that would be back within a
//            step is none (e = 0): an endless sequence of bounces ends in contact.
//   slides   dw/ds = b - gamma w + N n - mu N w/|w|, with N = -b.n - |w|^2 / R (R infinite for a plane), by the
//            midpoint rule, put back on the surface; up to the root of N, where it leaves, or of its speed, where it
//            stops.
//   sticks   as long as |b_t| <= mu N.
// The impulses of several surfaces that a particle touches are found together for the rest of the step, by projected
// Gauss-Seidel iteration (J. J. Moreau, Unilateral contact and dry friction in finite freedom dynamics, 1988; M. Jean,
// Comput. Methods Appl. Mech. Engrg. 177, 1999).
//
// Why order 2: a contact that lasts displaces by h^2 N / 2 within a step, so that b is wrong by O(h^2) there; an impact
// changes b by O(h), in one step. No further acceleration is evaluated. Dashpots and air act by speeds that contact
// changes by h N after they were evaluated: beside those the order is 1. On a moving sphere with friction a particle
// sticks and slips, and a slow slide turns along the force within |w| / (mu N), which is less than a step: there the
// order between two steps is anything from -0.8 to 5.7, and 2 only in the trend over many: 1.7 to 2.3 over 21 steps of
// 13 to 0.4 ms (mu 0.03 to 0.28 on a ball of 1 m, three motions).
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "mysim/terms/surface.h"

namespace crosscheck {

/// A surface's motion during one step: a cubic through its places at both ends, its velocity linear between those
/// there.
class SurfaceTrack {
 public:
  SurfaceTrack(const Surface& surface, double t_n, double t);
  const Surface& surface() const { return *surface_; }
  /// After a part s of the step, 0 <= s <= h (s -> m, m/s); exact at both ends.
  Vec3 origin(double s) const;
  Vec3 velocity(double s) const;
  const Vec3& acceleration() const { return acceleration_; }  // m/s^2

 private:
  const Surface* surface_;
  double h_;
  Vec3 origin_, velocity_, end_origin_, end_velocity_, acceleration_, rest_;
};

/// The surfaces in the step from t_n to t; they must outlive the tracks.
std::vector<SurfaceTrack> surface_tracks(std::span<const Surface> surfaces, double t_n, double t);

/// Takes a particle of the drag rate gamma (1/s) through a step of h as described above: x and v are x* and v* before,
/// and the end of the step after. What the contacts took, J per kilogram (contacts.h); nothing where none touched, and
/// then x and v are left as they are.
std::optional<double> resolve_events(std::span<const SurfaceTrack> surfaces, double h, double gamma, const Vec3& x_n,
                                     const Vec3& v_n, Eigen::Ref<Vec3> x, Eigen::Ref<Vec3> v);

}  // namespace crosscheck
