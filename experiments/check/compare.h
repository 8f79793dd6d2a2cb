// Helpers shared by relations: comparison of trajectories, and properties of scenes.
#pragma once

#include <functional>
#include <vector>

#include "experiments/check/relations.h"

namespace crosscheck {

/// The largest distance of a particle between two runs, relative to a bound for each sample (m), at the sample where
/// the ratio is largest. Ignores samples after the bound first exceeds a hundredth of `lengths`, because the motion
/// cannot be predicted there. Throws CannotBeAsked if that holds from the first sample.
RelationResult farthest(std::string what, const Trajectory& a, const Trajectory& b, const std::vector<double>& bound,
                        double lengths);

/// The run with its positions changed.
Trajectory with_positions(Trajectory path, const std::function<Points(const Points&)>& change);

/// The largest distance of a particle between two runs up to each sample, m.
std::vector<double> distances(const Trajectory& a, const Trajectory& b);

std::vector<double> sum_of(std::vector<double> a, const std::vector<double>& b);

/// The run with its step halved `times` times (settings.cpp).
const Trajectory& halved(Subject& subject, const Scene& scene, int times);

/// Rounding error of that run up to each sample, m.
std::vector<double> noise_at(Subject& subject, Scene scene, int times);

/// True for methods that follow run.tolerance, and for external programs that were observed to choose their steps.
bool chooses_steps(const Method& method);

/// Order of the method's rule; 1 if unknown.
int order_of(const Method& method);

/// External influences on a net: pins, wind, air, drag, contact, hard distances, a field.
struct Outside {
  bool pins = false, bending = false, gravity = false, wind = false, air = false, drag = false, dashpots = false,
       contact = false, constraints = false, field = false,
       changing = false;  // time-dependent: moving pins or surfaces, gusts
};
Outside outside_of(const Scene& scene);

/// True if every spring starts at its rest length, to 1e-12 of the scene's size.
bool springs_at_rest(const Scene& scene);

/// The springs of a chain that hangs from particle 0 to the last, in that order; empty if the scene is no such chain.
std::vector<Spring> hanging_chain_of(const Scene& scene);

}  // namespace crosscheck
