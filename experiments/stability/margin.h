// Warnings on the stability of longer runs, which a verdict at the end of a run cannot show.
#pragma once

#include <string>

#include "experiments/stability/spectrum.h"
#include "reference/method.h"

namespace crosscheck {

/// A sentence on a run that held, at step h (s), or nothing: the rule's step is within a tenth of what is stable once
/// every spring is stretched far (a net without drag then heats quietly and may fail later: a spring's stiffness acts
/// across its line as along it), or the rule has no stable step here and grows for certain, and by how much. Scenes
/// with dashpots or unequal drag rates, rules without a theory and adaptive ones have none.
std::string stability_warning(const Method& method, const Scene& scene, double h);

/// The factor of a step on the vibration's amplitude, by the eigenvalues of its amplification matrix;
/// 1 where the rule has none in closed form.
double growth_per_step(const Stepper& rule, const Vibration& vibration, double h);

}  // namespace crosscheck
