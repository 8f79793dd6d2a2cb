// The best solution known for a scene, with its tier and its error bar, and how it is found.
#pragma once

#include <cmath>
#include <optional>
#include <string>

#include "mysim/run/observers.h"

namespace crosscheck {

enum class Tier { exact = 1, exact_discrete = 2, converged = 3, another_engine = 4 };
std::string_view name_of(Tier tier);

struct Truth {
  Tier tier;
  std::string how;  // one sentence
  Trajectory trajectory;
  double error_bar;                // m, error bar of the RMS position error, at any sample
  std::vector<double> error_bars;  // m, the same up to each sample; empty where it is one and the same
  // a result of the in-house contact rule: the distance of others from it is a difference, and no error
  bool under_contact_rule = false;
  double until = INFINITY;  // s, holds up to here; the samples end with it
  // J, what contact took up to each sample (friction and impacts, less what moving spheres gave) and its error bars, of
  // time_stepping_truth(); empty elsewhere
  std::vector<double> contact, contact_bars;
};

/// Exact where the scene has a closed form (bar: round-off, 1e-15 x scene size x (1 + radians turned)); otherwise
/// converged on two independent routes (below), found once and kept in a cache (cache.h). Of other
/// scenes with contact only what the in-house contact rule converges to is known, for a while (below).
std::optional<Truth> truth_of(const Scene& scene, const Run& run);

// Truth where no closed form is known: two independent routes, each refined, and what they differ by.

/// One route is mysim's rk4, under hard distances that of MultiplierWorld: from half the scene's step (an eighth below
/// 50 particles; at most h omega = 1.4 of its fastest vibration) the step is halved, twice at least, until that changes
/// less than 1e-8 of the scene's size. The other is odeint's extrapolation under error control on the right-hand side
/// written apart (truth/independent), at three tolerances: the same with and without SUNDIALS, so that a truth does
/// not depend on what a machine has. The trajectory is that of the first at its last step. Its bar is the larger of the
/// difference of the two routes, with the second one's estimate on top, and of the first one's estimate, RMS over the
/// particles. An estimate is three times the last refinement's difference over 2^p - 1, with p as the last two
/// refinements show it, and the whole difference where they show none. On top comes 1e-15 of the scene's size, or the
/// random walk of a rounding in each step. None where a route fails or the bar exceeds a hundredth of the motion: known
/// to less than that is not known. The scene must be free of contact.
std::optional<Truth> converged_truth(const Scene& scene, const Run& run);

// Contact of few particles with spheres, at rest or moved: two independent routes as well, as long as both can be
// followed.

/// The path is that of an event-driven run on equations written apart (truth/independent/event_driven.cpp) at the last
/// of three tolerances, against mysim's leapfrog+events, whose step is halved as above, up to 1e7 steps of a particle;
/// the bar as above. It ends where the bar exceeds a hundredth of the motion, where events come too close to each other
/// to be followed, and where a particle moves between two spheres. None for more than 49 particles, where a route
/// fails at once, or where it would end before or at the first touch.
std::optional<Truth> event_truth(const Scene& scene, const Run& run);

// Contact of more particles, of cloths say: two rules of contact that share no equation, as long as the motion is not
// too sensitive for them to agree.

/// The path is that of mysim's leapfrog+events at the scene's step (at most h omega = 1.4), a half and a quarter of it,
/// against Moreau's time stepping on equations written apart (truth/independent/time_stepping.cpp) at 1/8, 1/16 and
/// 1/32. That one is of order 1: the bar is the largest of the difference of the two, of its last change, and of the
/// first route's estimate. It ends where the bar exceeds a third of the scene's tolerance or a hundredth of the motion:
/// where the motion becomes sensitive, which of two rules is right can no longer be told; and with the scene's window.
/// What contact took is what is missing from the balance of energies along the path, and its bar is found alike.
/// None where a route fails, where a particle touches two surfaces at once, or where it would end before or at the
/// first touch.
std::optional<Truth> time_stepping_truth(const Scene& scene, const Run& run);

// The limit of a scene with contact as the step goes to 0, under the in-house contact rule.

/// mysim's leapfrog at 1/8, 1/16 and 1/32 of the scene's step. The result holds as long as the last
/// difference (RMS over the particles, largest so far) is at most 2/3 of the one before, as at order 0.6 or more: with
/// contact every stepper is of first order on smooth motion. It ends 0.3 s after the first touch of a scene of several
/// free particles, and with the scene's window; the samples of the truth end there too. The bar is the last difference
/// over (its ratio - 1), what is left of a geometric series; at order 1 the difference itself. None where nothing
/// is touched, where no order is seen from the first touch on (after a hard impact, say), or where the bar exceeds a
/// hundredth of the motion.
std::optional<Truth> contact_truth(const Scene& scene, const Run& run);

}  // namespace crosscheck
