// Probes of collision response: small scenes whose result is known, and measures of penetration depth and asymmetry.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "experiments/tables/contact.h"
#include "mysim/scene/scene.h"
#include "reference/method.h"

namespace crosscheck {

Vec3 nearest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

/// Depth (m) to which the scene's triangles penetrate a contact surface at time t (s); negative if all are outside.
/// Triangles can penetrate a ball even if their corners lie on it. Returns nullopt for scenes without spheres or
/// triangles.
std::optional<double> depth_of_triangles(const Scene& scene, double t, const Points& x);

/// The partner of each particle under reflection in two planes through the ball's centre: normal to x, and normal to z.
class MirrorSymmetry {
 public:
  /// Returns nullopt if the scene is not symmetric in both planes to 1e-12 of its size (positions, velocities,
  /// gravity), or if wind, moving pins, several balls or moving balls may break the symmetry.
  static std::optional<MirrorSymmetry> of(const Scene& scene);
  /// Largest distance of a particle from its partner's mirror image, m.
  double asymmetry(const Points& x) const;

 private:
  Vec3 centre_;
  std::array<std::vector<int>, 2> partner_;
};

/// A particle dropped from 0.3 m onto the top of a ball of 0.5 m with a coefficient of restitution e.
Scene drop_on_ball(double restitution);
/// Height of the rebound above the contact surface, m; in theory e^2 0.3 m. Returns nullopt if the run failed.
std::optional<double> rebound(const Method& method, const Scene& scene, double step, Outcome& out);

/// A particle on a ball of 1.02 m without friction, placed 1 degree off the top, with the speed that it has there after
/// sliding from the very top.
Scene frictionless_slide();
struct Leaving {
  double angle, speed;  // degrees from the top and m/s, interpolated to the time when the gap first exceeds 1 mm
};
std::optional<Leaving> leaving(const Method& method, double step, Outcome& out);
/// The values of the closed form. Contact itself ends at cos(angle) = 2/3 (for a slide from the very top).
Leaving leaving_by_theory();

enum class Ground { ball, plane };
/// A particle at rest on a slope (`degrees`): on a plane, or on the side of a ball so large that it is locally flat.
Scene on_slope(double degrees, double friction, Ground ground);
struct ConeResult {
  double distance;  // m, in 0.5 s
  double coulomb;   // m, by Coulomb's law: 0 within the friction cone, otherwise g (sin - mu cos) t^2 / 2
  // sticks: moves less than 1 mm (on a plane 50 um); slides: moves by `coulomb`, within 10 % plus 1 mm (on a plane 50
  // um)
  ContactState state;
};
std::optional<ConeResult> cone(const Method& method, double degrees, double friction, Ground ground, double step,
                               Outcome& out);

/// A particle dropped from 0.3 m onto a floor with a coefficient of restitution of 0.8. The scene ends after the third
/// apex.
Scene drop_on_floor();
/// A particle that flies back and forth between two walls ten times, without loss of energy.
Scene between_walls();
/// Returns nullopt if the run failed or ended too early.
std::optional<double> measured(PlaneProbe probe, const Method& method, double step, Outcome& out);
double by_theory(PlaneProbe probe);

/// Scenes with contact whose truth is known: a slide that leaves the ball, without friction and with friction; a slide
/// that stops; a bouncing ball; the valley between two balls; a chain of nine particles on a ball.
std::vector<Scene> contact_order_probes();

/// A cloth of 1 m with 13 x 13 particles, dropped on the centre of a ball of 0.5 m with friction 0.5. It drapes over
/// the ball, and must remain as symmetric as it is at the start.
Scene drop_centred();
/// This cloth dropped 0.12 m off centre and with friction 0.25: by Coulomb's law it slides off.
Scene drop_aside();

}  // namespace crosscheck
