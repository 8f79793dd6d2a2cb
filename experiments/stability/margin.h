#pragma once

#include <string>

#include "experiments/stability/spectrum.h"
#include "reference/method.h"

namespace crosscheck {

/// A warning about longer runs, after a run that held at step h (s); empty if there is no reason to warn. Either the
/// step is within a tenth of the limit that the net would have if all springs were stretched far. (A net without drag
/// then slowly gains energy and may fail later: the stiffness of a stretched spring acts across its line, too.) Or the
/// rule has no stable step here; the warning then gives its growth. Empty for scenes with dashpots or unequal drag
/// rates, for rules without a theory, and for adaptive rules.
std::string stability_warning(const Method& method, const Scene& scene, double h);

/// Growth factor per step of the vibration's amplitude, from the eigenvalues of the rule's amplification matrix; 1 if
/// the rule has no such matrix in closed form.
double growth_per_step(const Stepper& rule, const Vibration& vibration, double h);

}  // namespace crosscheck
