// Helpers shared by relations: comparison of trajectories, and properties of scenes.
#pragma once

#include <functional>
#include <vector>

#include "experiments/check/relations.h"

namespace crosscheck {

/// At each sample, compares the largest distance of a particle between the two runs with the bound (m) of that sample.
/// Returns the result of the sample with the largest ratio. Ignores the first sample whose bound exceeds a hundredth of
/// `lengths` (m) and all later ones, because the motion is unpredictable from there. Throws CannotBeAsked if that
/// happens at the first sample.
RelationResult farthest(std::string what, const Trajectory& a, const Trajectory& b, const std::vector<double>& bound,
                        double lengths);

Trajectory with_positions(Trajectory path, const std::function<Points(const Points&)>& change);

/// The largest distance of a particle between two runs up to each sample, m.
std::vector<double> distances(const Trajectory& a, const Trajectory& b);

std::vector<double> sum_of(std::vector<double> a, const std::vector<double>& b);

/// The run with its step halved the given number of times.
const Trajectory& halved(Subject& subject, const Scene& scene, int times);

/// Rounding error (m) up to each sample of the run with its step halved the given number of times.
std::vector<double> noise_at(Subject& subject, Scene scene, int times);

/// True for methods that follow run.tolerance, and for external programs that were found to choose their own steps.
bool chooses_steps(const Method& method);

/// Order of the method's rule; 1 if unknown.
int order_of(const Method& method);

/// Influences other than springs.
struct Outside {
  bool pins = false, bending = false, gravity = false, wind = false, air = false, drag = false, dashpots = false,
       contact = false, constraints = false, field = false,
       changing = false;  // true if anything depends on time: moving pins or surfaces, gusts
};
Outside outside_of(const Scene& scene);

/// True if every spring starts at its rest length, to 1e-12 of the scene's size.
bool springs_at_rest(const Scene& scene);

/// The springs of a chain that hangs from particle 0, in order; empty if the scene is no such chain.
std::vector<Spring> hanging_chain_of(const Scene& scene);

}  // namespace crosscheck
