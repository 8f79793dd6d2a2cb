// Truth where no closed form is known: two independent routes, each refined, and what they differ by.
#pragma once

#include <optional>

#include "reference/truth.h"

namespace crosscheck {

/// One route is mysim's rk4, under hard distances that of MultiplierWorld: from half the scene's step (an eighth below
/// 50 particles; at most h omega = 1.4 of its fastest vibration) the step is halved, twice at least, until that changes
/// less than 1e-8 of the scene's size. The other is odeint's extrapolation under error control on the right-hand side
/// written apart (reference/independent), at three tolerances: the same with and without SUNDIALS, so that a truth does
/// not depend on what a machine has. The trajectory is that of the first at its last step. Its bar is the larger of the
/// difference of the two routes, with the second one's estimate on top, and of the first one's estimate, RMS over the
/// particles. An estimate is three times the last refinement's difference over 2^p - 1, with p as the last two
/// refinements show it, and the whole difference where they show none. On top comes 1e-15 of the scene's size, or the
/// random walk of a rounding in each step. None where a route fails or the bar exceeds a hundredth of the motion: known
/// to less than that is not known. The scene must be free of contact.
std::optional<Truth> converged_truth(const Scene& scene, const Run& run);

}  // namespace crosscheck
