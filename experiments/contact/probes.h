// Probes of collision response: small scenes with a known result, and measurements of penetration depth and asymmetry
// in runs.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "experiments/tables/contact.h"
#include "mysim/scene/scene.h"
#include "reference/method.h"

namespace crosscheck {

// Penetration depth of a surface in a ball: of its particles, and of the triangles between them.

/// Point of the triangle a b c nearest to p, m.
Vec3 nearest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

/// Depth of the deepest point of the scene's triangles in a contact surface at time t (s), m; negative outside.
/// Triangles can penetrate a ball even if their corners lie on it. Nothing without spheres or without triangles.
std::optional<double> depth_of_triangles(const Scene& scene, double t, const Points& x);

// Scenes that are symmetric at the start, and their later asymmetry.

/// The partner of each particle under reflection in the planes through the ball's centre normal to x and to z.
class MirrorSymmetry {
 public:
  /// Nothing if the scene is not symmetric in both planes to 1e-12 of its size (positions, velocities, gravity), or if
  /// wind, moving pins, several balls or moving balls may break the symmetry.
  static std::optional<MirrorSymmetry> of(const Scene& scene);
  /// Largest distance of a particle from its partner's mirror image, m.
  double asymmetry(const Points& x) const;

 private:
  Vec3 centre_;
  std::array<std::vector<int>, 2> partner_;  // for the planes normal to x and to z
};

// Probes of collision response: small scenes, each with a result that is known or can be classified.

// ---- rebound ----
/// A particle dropped from 0.3 m onto the top of a ball of 0.5 m with a coefficient of restitution e.
Scene drop_on_ball(double restitution);
/// Height of the rebound above the contact surface, m; by theory e^2 0.3 m. Empty if the run failed.
std::optional<double> rebound(const Method& method, const Scene& scene, double step, Outcome& out);

// ---- leaving ----
/// A particle on a ball of 1.02 m without friction, 1 degree off the top, with the speed of a particle that slides from
/// the very top.
Scene frictionless_slide();
struct Leaving {
  double angle, speed;  // degrees from the top, m/s: where the gap first exceeds 1 mm, interpolated between two steps
};
std::optional<Leaving> leaving(const Method& method, double step, Outcome& out);
/// Angle and speed from the closed form. Contact itself ends at cos(angle) = 2/3 (from the very top).
Leaving leaving_by_theory();

// ---- cone ----
enum class Ground { ball, plane };
/// A particle at rest on a slope (degrees): a plane, or the side of a ball so large that it is locally flat.
Scene on_slope(double degrees, double friction, Ground ground);
struct ConeResult {
  double distance;     // m, in 0.5 s
  double coulomb;      // m, by Coulomb's law: 0 within the cone, else g (sin - mu cos) t^2 / 2
  ContactState state;  // sticks: below 1 mm; slides: within a tenth (and 1 mm) of Coulomb's distance; 50 um on a plane
};
std::optional<ConeResult> cone(const Method& method, double degrees, double friction, Ground ground, double step,
                               Outcome& out);

// ---- planes ----
/// A particle dropped from 0.3 m onto a floor with a coefficient of restitution of 0.8, until after its third apex.
Scene drop_on_floor();
/// A particle that flies back and forth between two walls without loss, ten times.
Scene between_walls();
/// Value of a probe in a run; empty if the run failed or did not get that far.
std::optional<double> measured(PlaneProbe probe, const Method& method, double step, Outcome& out);
double by_theory(PlaneProbe probe);

// ---- order ----
/// Scenes with contact and a known truth, for the order of contact: a slide that leaves the ball, without friction and
/// with; a slide that stops; a bouncing ball; the valley between two balls; a chain of nine particles on a ball.
std::vector<Scene> contact_order_probes();

// ---- drape ----
/// A cloth of 1 m, 13 x 13 particles, dropped on the centre of a ball of 0.5 m with friction 0.5: it hangs over the
/// ball and must remain as symmetric as it starts.
Scene drop_centred();
/// That cloth, off centre by 0.12 m and with a friction of 0.25: by Coulomb's law it slides off.
Scene drop_aside();

}  // namespace crosscheck
