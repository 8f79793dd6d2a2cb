// What work would cost, before it is done: so that what is left out for its cost is the same on every machine.
#pragma once

#include "reference/method.h"

namespace crosscheck {

/// CPU time of a run of the method, s: from the number of its steps, the particles and the springs; measured with this
/// suite's builds once, good to a factor of about 3. Rules that solve an equation in each step take more products with
/// the matrix at longer steps.
double estimated_seconds(const Method& method, const Scene& scene, const Run& run);
/// The same of so many steps of the scene's own.
double estimated_seconds(const Method& method, const Scene& scene, long steps);

/// The same of an adaptive method, whose steps are its own choice: as many evaluations per time as up to the
/// first sample, which is run.
double estimated_as_it_begins(const Method& method, const Scene& scene, Run run);

}  // namespace crosscheck
