// What relations have in common: trajectories side by side, and what a scene has.
#pragma once

#include <functional>
#include <vector>

#include "experiments/check/relations.h"

namespace crosscheck {

/// The largest distance of a particle in one run from its place in the other, against a bound for each sample (m), at
/// the sample where it is farthest over. Samples from where a bound exceeds a hundredth of the lengths on are left out:
/// there the motion cannot be predicted. Throws CannotBeAsked where that is so from the first.
RelationResult farthest(std::string what, const Trajectory& a, const Trajectory& b, const std::vector<double>& bound,
                        double lengths);

/// The run with its positions changed.
Trajectory with_positions(Trajectory path, const std::function<Points(const Points&)>& change);

/// The largest distance of a particle in two runs up to each sample, m.
std::vector<double> distances(const Trajectory& a, const Trajectory& b);

std::vector<double> sum_of(std::vector<double> a, const std::vector<double>& b);

/// The run with its step halved so many times (settings.cpp).
const Trajectory& halved(Subject& subject, const Scene& scene, int times);

/// The rounding of such a run, m, up to each sample.
std::vector<double> noise_at(Subject& subject, Scene scene, int times);

/// True for methods that follow run.tolerance, and for outside programs that were found to choose their steps.
bool chooses_steps(const Method& method);

/// The order of the method's rule; 1 where it is not known.
int order_of(const Method& method);

/// Reports what acts on a net from outside: pins, wind, air, drag, contact, hard distances, a field.
struct Outside {
  bool pins = false, bending = false, gravity = false, wind = false, air = false, drag = false, dashpots = false,
       contact = false, constraints = false, field = false,
       changing = false;  // with time: moved pins or surfaces, gusts
};
Outside outside_of(const Scene& scene);

/// Whether every spring starts as long as it is at rest, to 1e-12 of the scene's size.
bool springs_at_rest(const Scene& scene);

/// The springs of a chain that hangs from particle 0 down to the last, in that order; empty where it is none.
std::vector<Spring> hanging_chain_of(const Scene& scene);

}  // namespace crosscheck
