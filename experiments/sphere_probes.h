// Probes of collision response: small scenes with a ball, each with one answer that is known or can be told apart.
#pragma once

#include <optional>
#include <string>

#include "reference/method.h"

namespace crosscheck {

// ---- rebound ----
/// A particle dropped by 0.3 m on the top of a ball of 0.5 m that returns the part e of its speed.
Scene drop_on_ball(double restitution);
/// How high it rises again, m above the contact surface; by theory e^2 0.3 m. Empty where the run failed.
std::optional<double> rebound(const Method& method, const Scene& scene, double step, Outcome& out);

// ---- leaving ----
/// A particle on a ball of 1.02 m without friction, 1 degree off the top, at the speed that it has there when it slides
/// from the very top.
Scene frictionless_slide();
struct Leaving {
  double angle, speed;  // degrees from the top, m/s: where the gap first passes 1 mm, between two steps
};
std::optional<Leaving> leaving(const Method& method, double step, Outcome& out);
/// The same of the closed form. Contact itself ends where cos(angle) = 2/3 (from the very top).
Leaving leaving_by_theory();

// ---- cone ----
/// A particle at rest on a slope (degrees), as the side of a ball so large that it is flat here.
Scene on_slope(double degrees, double friction);
enum class Hold { sticks, slides, neither };
std::string_view name_of(Hold hold);
struct ConeAnswer {
  double way;      // m, in 0.5 s
  double coulomb;  // m, by Coulomb's law: 0 within the cone, else g (sin - mu cos) t^2 / 2
  Hold hold;       // sticks: less than 1 mm; slides: Coulomb's way within a tenth (and 1 mm)
};
std::optional<ConeAnswer> cone(const Method& method, double degrees, double friction, double step, Outcome& out);

// ---- drape ----
/// Cloths of 1 m, 13 x 13 particles, dropped on a ball of 0.5 m. Centred, with friction 0.5: it hangs over the ball and
/// must stay as symmetric as it starts.
Scene drop_centred();
/// With its centre 0.12 m aside of the ball's and a friction of 0.25: by Coulomb's law it slides off.
Scene drop_aside();

}  // namespace crosscheck
