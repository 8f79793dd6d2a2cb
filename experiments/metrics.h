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
/// Empty without spheres.
std::optional<double> clearance(const Scene& scene, double t, const Points& x);

/// Mean speed of the touching particles along the surface, relative to it, m/s. Touching means closer than a thousandth
/// of the sphere's radius (for a plane, of the scene's size). Empty without contact or without velocities.
std::optional<double> creep(const Scene& scene, double t, const Points& x, const Points& v);

/// The scene with every free particle moved by `size` (m) in a seeded random direction.
Scene perturbed(const Scene& scene, double size, unsigned seed);

/// Growth of a perturbation of 1e-10 m of every free particle, in seeded random directions.
struct Growth {
  std::vector<double> t;       // s, of the samples
  std::vector<double> factor;  // largest distance so far of a particle from its unperturbed position, over 1e-10 m

  /// The largest factor up to `time` (s); 0 if there is no earlier sample.
  double until(double time) const;
  /// The window of predictability, s: last sample before the factor exceeds 1e3.
  double window() const;
};
/// From two runs of the method. `unperturbed`: the unperturbed run with as many samples, if it exists already.
Growth growth_of(const Method& method, const Scene& scene, const Run& run, const Trajectory* unperturbed = nullptr);

/// The growth factor of runs that end at `until` (s).
double perturbation_growth(const Method& method, const Scene& scene, double step, double until);

/// Largest expected difference between two engines that use the same rule but sum the forces in a different order, m:
/// about 1e-15 of the lengths that occur (the scene's size and its motion, m) per step, times the growth of a
/// perturbation, times 100 for thousands of steps that accumulate like a random walk. Empty if a perturbation grows
/// more than 1e6-fold, because single positions are then unpredictable.
std::optional<double> round_off_bound(const Scene& scene, double motion, double growth);

/// The corresponding bound between single and double precision, m. Each step has about ten roundings of positions to
/// 6e-8 of the lengths that occur. They accumulate like a random walk and grow like a perturbation. The rounding of
/// speeds contributes as much again by the end of the run.
std::optional<double> single_precision_bound(const Scene& scene, double motion, double growth, long steps);

/// round_off_bound() or single_precision_bound(), by the precision that the method's runs show (which_rule.h).
std::optional<double> round_off_bound_of(const Method& method, const Scene& scene, double motion, double growth,
                                         long steps);

struct Statistic {
  std::string quantity, unit;
  double mean, deviation;  // sample standard deviation (n - 1), 0 for one run
};

struct ContactStatistics {
  static constexpr int runs = 16;
  /// Initial displacement of each particle in a seeded direction, m. Far above rounding errors that have grown in the
  /// window (1e-16 m a thousandfold), and at most a hundredth of the smallest tolerance of a shipped scene.
  static constexpr double perturbation = 1e-6;
};

/// Quantities of one run with velocities, for scenes with contact, without deviations. At the end: height (y) of the
/// centre of mass, kinetic energy, elastic energy and outline (RMS distance of the free particles from the vertical
/// through their centre of mass). And the smallest clearance at any sample.
std::vector<Statistic> contact_quantities(const Scene& scene, const Trajectory& path);

/// Means and deviations of contact_quantities() over 16 perturbed runs. Empty if the method does not support the scene
/// or a run fails.
std::vector<Statistic> contact_statistics(const Method& method, const Scene& scene, const Run& run);

}  // namespace crosscheck
