// The best known solution of a scene, with its tier and error bar.
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
  double error_bar;                // m, for the RMS position error at any sample
  std::vector<double> error_bars;  // m, up to each sample; empty if constant
  // computed by mysim's own contact rule, so that the distance of other rules is a difference, not an error
  bool under_contact_rule = false;
  double until = INFINITY;  // s, valid up to this time, at which the samples end
  // J, up to each sample: energy taken by contact (friction and impacts, minus the work of moving spheres) and its
  // error bars, by time_stepping_truth(); otherwise empty
  std::vector<double> contact, contact_bars;
};

/// Exact if the scene has a closed form (bar: round-off, 1e-15 x scene size x (1 + radians turned)). Otherwise
/// converged on two independent routes (below), computed once and cached (cache.h). For other scenes with contact, only
/// the limit of mysim's own contact rule is known, for a limited time (below).
std::optional<Truth> truth_of(const Scene& scene, const Run& run);

// Without a closed form: two independent routes, each refined, and their difference.

/// The first route is mysim's rk4 or, with hard distances, rk4 of MultiplierWorld. It starts at half the scene's step
/// (an eighth below 50 particles, twice the step with hard distances; at most h omega = 1.4 of the fastest vibration).
/// The step is halved, at least twice, until the result changes by less than 1e-8 of the scene's size or halving no
/// longer helps. The second route is odeint's extrapolation under error control on the independent right-hand side
/// (truth/independent), at three tolerances. SUNDIALS is not used, so that a truth does not depend on the installed
/// packages.
/// The trajectory is that of the first route at its last step. Its error bar, RMS over the particles, is the larger of
/// two values: the first route's estimate, and the difference of the routes plus the second one's estimate. An estimate
/// is three times the last refinement's difference divided by 2^p - 1, where p is the order that the last two
/// refinements show. If they show no order, it is the whole difference. Rounding is added: 1e-15 of the scene's size,
/// or the random walk of one rounding per step. Returns nullopt if a route fails or the bar exceeds a hundredth of the
/// motion: a less accurate result is no truth. The scene must be free of contact.
std::optional<Truth> converged_truth(const Scene& scene, const Run& run);

// Contact of few particles: two independent routes, as long as both can be followed.

/// The path is that of an event-driven run on independent equations (truth/independent/event_driven.cpp) at the last of
/// three tolerances. It is compared with mysim's leapfrog+events, whose step is halved as above, up to 1e7 steps of a
/// particle; the bar is as above. The truth ends when the bar exceeds a hundredth of the motion, when events are too
/// close to each other to be followed, or when a particle moves between two surfaces. Returns nullopt for more than 49
/// particles, if a route fails at once, or if the truth would end before or at the first touch.
std::optional<Truth> event_truth(const Scene& scene, const Run& run);

// Contact of more particles, e.g. of cloths: two contact rules that share no equation, as long as they agree.

/// The path is that of mysim's leapfrog+events at the last of three steps: the scene's step (at most h omega = 1.4), a
/// half and a quarter of it. It is compared with Moreau's time stepping on independent equations
/// (truth/independent/time_stepping.cpp) at 1/8, 1/16 and 1/32 of that step. Because the time stepping is of order 1,
/// the bar is the largest of the distance between the routes, the last change of the second, and the estimate of the
/// first. The truth ends when the bar exceeds a third of the scene's tolerance or a hundredth of the motion: once the
/// motion is sensitive, it is undecidable which of the two rules is right. It also ends with the scene's window. The
/// energy taken by contact is the energy missing from the balance along the path; its bar is found in the same way.
/// Returns nullopt if a route fails, if a particle touches two surfaces at once, or if the truth would end before or at
/// the first touch.
std::optional<Truth> time_stepping_truth(const Scene& scene, const Run& run);

// Limit of mysim's own contact rule as the step approaches 0.

/// mysim's leapfrog at 1/8, 1/16 and 1/32 of the scene's step. The result is valid as long as the last difference (RMS
/// over the particles, largest so far) is at most 2/3 of the previous one, as for order 0.6 or more. With contact every
/// stepper is of first order on smooth motion. The truth ends with the scene's window and, with several free particles,
/// at the latest sqrt(0.9 R / g) after the first touch, where R is the smallest radius of a sphere (0.3 s for 1 m). The
/// bar is the last difference divided by r - 1, where r is the previous difference divided by the last one: the
/// remainder of a geometric series, and at order 1 the last difference itself. Returns nullopt if nothing is touched,
/// if no order is visible from the first touch on (after a hard impact, for example), or if the bar exceeds a hundredth
/// of the motion.
std::optional<Truth> contact_truth(const Scene& scene, const Run& run);

}  // namespace crosscheck
