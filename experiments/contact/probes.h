// Probes of collision response: small scenes with a known result, and measurements of runs: penetration depth,
// asymmetry.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "experiments/tables/contact.h"
#include "mysim/scene/scene.h"
#include "reference/method.h"

namespace crosscheck {

// The penetration depth of a surface in a ball: its particles, and the triangles between them.

/// Point of the triangle a b c nearest to p, m.
Vec3 nearest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

/// Depth of the deepest point of the scene's triangles in a contact surface at time t (s), m; negative outside.
/// A triangle cuts a ball although its corners lie on it. Nothing without spheres or without triangles.
std::optional<double> depth_of_triangles(const Scene& scene, double t, const Points& x);

// Scenes that are symmetric at the start, and how far they are from it later.

/// The partners of the particles under reflection in planes through the ball's centre, across x and across z.
class MirrorSymmetry {
 public:
  /// Nothing where the scene is not symmetric in both planes to 1e-12 of its size: places, speeds, gravity; and where
  /// wind, moved pins, several or moving balls may break the symmetry.
  static std::optional<MirrorSymmetry> of(const Scene& scene);
  /// Largest distance of a particle from its partner's mirror image, m.
  double asymmetry(const Points& x) const;

 private:
  Vec3 centre_;
  std::array<std::vector<int>, 2> partner_;  // across x, across z
};

// Probes of collision response: small scenes, each with one result that is known or can be classified.

// ---- rebound ----
/// A particle dropped by 0.3 m on the top of a ball of 0.5 m that returns the part e of its speed.
Scene drop_on_ball(double restitution);
/// Height of its rebound, m above the contact surface; by theory e^2 0.3 m. Empty where the run failed.
std::optional<double> rebound(const Method& method, const Scene& scene, double step, Outcome& out);

// ---- leaving ----
/// A particle on a ball of 1.02 m without friction, 1 degree off the top, at the speed that it has there when it slides
/// from the very top.
Scene frictionless_slide();
struct Leaving {
  double angle, speed;  // degrees from the top, m/s: where the gap first passes 1 mm, between two steps
};
std::optional<Leaving> leaving(const Method& method, double step, Outcome& out);
/// Angle and speed of the closed form. Contact itself ends where cos(angle) = 2/3 (from the very top).
Leaving leaving_by_theory();

// ---- cone ----
enum class Ground { ball, plane };
/// A particle at rest on a slope (degrees): a plane, or the side of a ball so large that it is flat here.
Scene on_slope(double degrees, double friction, Ground ground);
struct ConeResult {
  double distance;     // m, in 0.5 s
  double coulomb;      // m, by Coulomb's law: 0 within the cone, else g (sin - mu cos) t^2 / 2
  ContactState state;  // sticks: less than 1 mm; slides: Coulomb's distance within a tenth (and 1 mm); 50 um on a plane
};
std::optional<ConeResult> cone(const Method& method, double degrees, double friction, Ground ground, double step,
                               Outcome& out);

// ---- planes ----
/// A particle dropped by 0.3 m that a floor returns with 0.8 of its speed, until its third apex is over.
Scene drop_on_floor();
/// A particle that flies to and fro between two walls without loss, ten times.
Scene between_walls();
/// Value of a probe in a run; empty where it failed or never came so far.
std::optional<double> measured(PlaneProbe probe, const Method& method, double step, Outcome& out);
double by_theory(PlaneProbe probe);

// ---- order ----
/// Scenes with contact whose truth is known, for the order of contact: a slide that leaves, without friction and with;
/// a stop; a bouncing ball; the valley between two balls; a chain of nine on a ball.
std::vector<Scene> contact_order_probes();

// ---- drape ----
/// Cloths of 1 m, 13 x 13 particles, dropped on a ball of 0.5 m. Centred, with friction 0.5: it hangs over the ball and
/// must stay as symmetric as it starts.
Scene drop_centred();
/// With its centre 0.12 m aside of the ball's and a friction of 0.25: by Coulomb's law it slides off.
Scene drop_aside();

}  // namespace crosscheck
