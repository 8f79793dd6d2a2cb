// Metrics of trajectories: distances, contact, growth of a perturbation, means over perturbed runs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mysim/run/observers.h"
#include "reference/method.h"

namespace crosscheck {

/// Mass-weighted mean position of the free particles, m. In first-order scenes all masses are 1.
Vec3 centre_of_mass(const Scene& scene, const Points& x);

/// Largest RMS distance of the particles from their start over the run, m: the scale of errors.
double motion_of(const Trajectory& trajectory);

/// Smallest distance of a free particle from the nearest sphere's contact surface at time t (s), m; negative inside.
/// Empty without a sphere.
std::optional<double> clearance(const Scene& scene, double t, const Points& x);

/// Mean speed of the particles in contact along the surface, relative to the surface, m/s. In contact means closer than
/// a thousandth of the sphere's radius (for a plane, of the scene's size). Empty without contact, and without
/// velocities.
std::optional<double> creep(const Scene& scene, double t, const Points& x, const Points& v);

/// The scene with every free particle moved by `size` (m) in a seeded random direction.
Scene perturbed(const Scene& scene, double size, unsigned seed);

/// Growth of a perturbation of 1e-10 m of every free particle, in seeded random directions.
struct Growth {
  std::vector<double> t;       // s, of the samples
  std::vector<double> factor;  // largest distance so far of a particle from its unperturbed position, over 1e-10 m

  /// The largest factor up to a time (s); 0 if there is no sample up to then.
  double until(double time) const;
  /// The window of predictability, s: time of the last sample before the factor exceeds 1e3, or of the last sample if
  /// it never does.
  double window() const;
};
/// Computes the growth from two runs of the method. `unperturbed`, if given, is the unperturbed run with as many
/// samples.
Growth growth_of(const Method& method, const Scene& scene, const Run& run, const Trajectory* unperturbed = nullptr);

/// The growth factor up to `until` (s), from runs that end then.
double perturbation_growth(const Method& method, const Scene& scene, double step, double until);

/// Largest difference to expect between two engines of the same rule that sum the same forces in another order, m:
/// about 1e-15 of the lengths that occur (the scene's size and its motion, m) per step, times the growth of a
/// perturbation, times 100 for thousands of steps that accumulate like a random walk. Empty if a perturbation grows
/// more than 1e6-fold, because single positions cannot be predicted then.
std::optional<double> round_off_bound(const Scene& scene, double motion, double growth);

/// The corresponding bound for an engine in single precision, compared with one in double precision, m. Each step
/// rounds positions to 6e-8 of the lengths that occur; the rounding of speeds contributes as much again by the end of
/// the run. Roundings accumulate like a random walk over the steps, each grows like a perturbation, and a step has
/// about ten.
std::optional<double> single_precision_bound(const Scene& scene, double motion, double growth, long steps);

/// round_off_bound() or single_precision_bound(), by the precision that the runs of the method show (which_rule.h).
std::optional<double> round_off_bound_of(const Method& method, const Scene& scene, double motion, double growth,
                                         long steps);

// Statistics of motions whose single positions cannot be predicted: means over perturbed runs, and their spread.

struct Statistic {
  std::string quantity, unit;
  double mean, deviation;  // over the runs; sample standard deviation (n - 1), 0 for one run
};

struct ContactStatistics {
  static constexpr int runs = 16;
  /// Initial displacement of each particle in a seeded direction, m. Far above the growth of rounding errors in the
  /// window (1e-16 m a thousandfold), and at most a hundredth of the smallest tolerance of a shipped scene.
  static constexpr double perturbation = 1e-6;
};

/// Quantities of one run with velocities, without deviations: height (y) of the centre of mass, kinetic energy, elastic
/// energy and outline (RMS distance of the free particles from the vertical through their centre of mass) at the end,
/// and the smallest clearance at any sample. For scenes with contact.
std::vector<Statistic> contact_quantities(const Scene& scene, const Trajectory& path);

/// Means and deviations of contact_quantities() over 16 runs of the method with different seeds of the perturbation.
/// Empty if the method does not support the scene or a run fails. For scenes with contact.
std::vector<Statistic> contact_statistics(const Method& method, const Scene& scene, const Run& run);

}  // namespace crosscheck
