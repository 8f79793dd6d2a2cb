// Truth where no closed form is known: two independent routes, each refined, and what they differ by.
#pragma once

#include <optional>

#include "reference/truth.h"

namespace crosscheck {

/// One route is mysim's rk4, under hard distances that of MultiplierWorld: from half the scene's step (an eighth below
/// 50 particles; at most h omega = 1.4 of its fastest vibration) the step is halved until that changes less than 1e-8
/// of the scene's size. The other is a rule of order 8 under error control, SUNDIALS ARKODE where the suite was built
/// with it and else odeint, on the right-hand side written apart (reference/independent), at two tolerances. The
/// trajectory is that of the first at its last step. Its bar is the largest of the difference of the two routes and of
/// each route's own refinement difference, RMS over the particles; never below 1e-15 of the scene's size or the random
/// walk of a rounding in each step. None where a route fails or the bar exceeds a hundredth of the motion: known to
/// less than that is not known. The scene must be free of contact.
std::optional<Truth> converged_truth(const Scene& scene, const Run& run);

}  // namespace crosscheck
