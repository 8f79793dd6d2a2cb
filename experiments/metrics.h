// Numbers taken from trajectories: distances, contact, growth of a perturbation, means over perturbed runs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mysim/run/observers.h"
#include "reference/method.h"

namespace crosscheck {

/// Mass-weighted mean of the positions of the free particles, m (mean of all where there is no mass).
Vec3 centre_of_mass(const Scene& scene, const Points& x);

/// RMS distance of the particles from where they started, its largest value over the run: the scale of errors, m.
double motion_of(const Trajectory& trajectory);

/// Smallest distance of a free particle from the nearest sphere's contact surface at time t (s), m; negative inside.
/// Empty without a sphere.
std::optional<double> clearance(const Scene& scene, double t, const Points& x);

/// Mean speed along the surface, as seen from the sphere, of the particles that touch one (closer than 1 mm), m/s;
/// empty when none does, and without velocities.
std::optional<double> creep(const Scene& scene, double t, const Points& x, const Points& v);

/// The scene with every free particle moved by `size` (m) in a seeded random direction.
Scene perturbed(const Scene& scene, double size, unsigned seed);

/// How a perturbation of 1e-10 m of every free particle, in seeded random directions, grows.
struct Growth {
  std::vector<double> t;       // s, of the samples
  std::vector<double> factor;  // largest distance of a particle from its unperturbed self so far, over 1e-10 m

  /// The largest factor up to a time (s); 0 where nothing was sampled.
  double until(double time) const;
  /// The window of predictability, s: up to the last sample before the factor exceeds 1e3; the last sample where it
  /// never does.
  double window() const;
};
/// From two runs of the method; the unperturbed one may be at hand (the same run, with as many samples).
Growth growth_of(const Method& method, const Scene& scene, const Run& run, const Trajectory* unperturbed = nullptr);

/// The factor up to `until` (s), of runs that end there.
double perturbation_growth(const Method& method, const Scene& scene, double step, double until);

/// The most that two engines of the same rule may differ by, m, where they sum the same forces in another order: about
/// 1e-15 of the lengths that occur (the scene's size and its motion, m) per step, times the growth of a perturbation,
/// times 100 for thousands of steps that add up like a random walk. Empty where a perturbation grows more than
/// 1e6-fold: there single positions cannot be predicted.
std::optional<double> round_off_bound(const Scene& scene, double motion, double growth);

/// The same for an engine in single precision against one in double, m: each step rounds places to 6e-8 of the lengths
/// that occur and speeds to 6e-8 of theirs, which is as much again by the end of the run; over the steps the roundings
/// add up like a random walk, each grows like a perturbation, and there are about ten of them in a step.
std::optional<double> single_precision_bound(const Scene& scene, double motion, double growth, long steps);

/// The one of them for the precision that the runs of the method show (which_rule.h).
std::optional<double> round_off_bound_of(const Method& method, const Scene& scene, double motion, double growth,
                                         long steps);

// Statistics of a motion whose single positions cannot be predicted: means over perturbed runs, and their spread.

struct Statistic {
  std::string quantity, unit;
  double mean, deviation;  // over the runs; deviation with n - 1, 0 of one run
};

struct ContactStatistics {
  static constexpr int runs = 16;
  /// m: each particle starts that far from its place, in a seeded direction. Far above what rounding can grow to in the
  /// window (1e-16 m a thousandfold), a hundredth of the smallest tolerance of a shipped scene at most.
  static constexpr double perturbation = 1e-6;
};

/// Of one run with velocities, without deviations: height (y) of the centre of mass, kinetic and elastic energy and
/// outline (RMS distance of the free particles from the vertical through their centre of mass) at the end, and the
/// smallest clearance at any sample. For scenes with a sphere.
std::vector<Statistic> contact_quantities(const Scene& scene, const Trajectory& path);

/// Means and deviations of the same over 16 runs of the method that differ in the seed of the perturbation. Empty where
/// the method does not take the scene or a run fails. For scenes with a sphere.
std::vector<Statistic> contact_statistics(const Method& method, const Scene& scene, const Run& run);

}  // namespace crosscheck
