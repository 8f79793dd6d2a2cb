// The functions behind the table of quantities.
#pragma once

#include "experiments/regress/cases.h"
#include "reference/truth/truth.h"

namespace crosscheck {

struct Observation {
  const Case& test_case;
  const CaseRun& case_run;
  const Scene& scene() const { return test_case.scene; }
  const Trajectory& path() const { return case_run.trajectory; }
};
using Quantities = std::vector<Quantity>;

/// The truth over the scene's run where it has a closed form, else nothing: a converged one takes minutes to find.
std::optional<Truth> exact_truth(const Scene& scene);

// ---- of the run itself ----
/// How far the particles are from where they started, RMS.
void offsets(const Observation& seen, Quantities& out);
/// Positions along directions drawn once for each particle: they differ where means over the particles agree.
void places(const Observation& seen, Quantities& out);
/// Kinetic, elastic and gravitational energy, above that at the start.
void energies(const Observation& seen, Quantities& out);
void peak_stretch(const Observation& seen, Quantities& out);
/// The offset at the end as waves along and across the scene as it is written: sag is the first of them.
void shape(const Observation& seen, Quantities& out);
/// How far the lowest particle, along gravity, hangs below where it was at most.
void sag(const Observation& seen, Quantities& out);
/// Twice the mean time between turning points of the mean of the particles, parabolas through three samples.
void period(const Observation& seen, Quantities& out);
/// The last time at which the kinetic energy falls through a hundredth of its largest value, of runs that come to rest.
void settle_time(const Observation& seen, Quantities& out);
void smallest_clearance(const Observation& seen, Quantities& out);

// ---- of a ball ----
/// How high particles rise above a ball after they first touched it, m.
void rebound_height(const Observation& seen, Quantities& out);

/// Of a particle that starts on a ball: how far from the top it is when it first rises 1 mm above the contact surface,
/// degrees.
void leaving_angle(const Observation& seen, Quantities& out);

// ---- of runs of their own ----
/// Largest RMS distance from the same run at half the step, m, where there is no closed form: an estimate of the error,
/// right to a factor that its order says. One more run, twice as long; not of scenes without an ingredient.
void change_at_half_the_step(const Observation& seen, Quantities& out);

/// log2 of the error against the closed form over that at half the step, where there is one: near the rule's order.
/// One more run. Where the error is below 1e-10 of the scene's size it says nothing, and is left out.
void order_of_error(const Observation& seen, Quantities& out);

/// s, by bisection from rest, known to 0.2 %: on scenes of at most 12 free coordinates, of rules with a finite limit.
/// About 25 runs of 4000 steps.
void largest_stable_step(const Observation& seen, Quantities& out);

}  // namespace crosscheck
