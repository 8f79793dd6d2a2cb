#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mysim/run/observers.h"
#include "reference/method.h"

namespace crosscheck {

/// Mass-weighted mean position of the free particles, m. In first-order scenes all masses are 1.
Vec3 centre_of_mass(const Scene& scene, const Points& x);

/// Largest RMS distance (m) of the particles from their start during the run, which is the scale of errors.
double motion_of(const Trajectory& trajectory);

/// Smallest distance (m) of a free particle from the contact surface of the nearest sphere at time t (s); negative if a
/// particle is inside. Returns nullopt for scenes without spheres.
std::optional<double> clearance(const Scene& scene, double t, const Points& x);

/// Mean speed (m/s) of the touching particles along the surface, relative to the surface. Touching particles are closer
/// than a thousandth of the sphere's radius (for a plane, of the scene's size). Returns nullopt without contact or
/// without velocities.
std::optional<double> creep(const Scene& scene, double t, const Points& x, const Points& v);

/// The scene with every free particle moved by `size` (m) in a seeded random direction.
Scene perturbed(const Scene& scene, double size, unsigned seed);

/// Growth of a perturbation of 1e-10 m of every free particle, in seeded random directions.
struct Growth {
  std::vector<double> t;       // s, of the samples
  std::vector<double> factor;  // largest distance so far from the unperturbed position, in units of 1e-10 m

  /// The largest factor up to `time` (s); 0 if no sample is that early.
  double until(double time) const;
  /// The window of predictability, s: the last sample before the factor exceeds 1e3.
  double window() const;
};
/// Growth, from two runs of the method. `unperturbed`: the unperturbed run with the same samples, if it has been
/// computed already.
Growth growth_of(const Method& method, const Scene& scene, const Run& run, const Trajectory* unperturbed = nullptr);

/// The growth factor of runs that end at `until` (s).
double perturbation_growth(const Method& method, const Scene& scene, double step, double until);

/// Largest expected difference (m) between two engines that use the same rule but sum the forces in a different order:
/// about 1e-15 of the lengths that occur (the scene's size and its motion, m) per step, times the growth of a
/// perturbation, times 100 for thousands of steps that accumulate like a random walk. Returns nullopt if a perturbation
/// grows more than 1e6-fold, because single positions are then unpredictable.
std::optional<double> round_off_bound(const Scene& scene, double motion, double growth);

/// Bound on the difference between single and double precision, m. Each step has about ten roundings of positions to
/// 6e-8 of the lengths that occur. These errors accumulate like a random walk and grow like a perturbation. The
/// rounding of speeds contributes the same amount by the end of the run.
std::optional<double> single_precision_bound(const Scene& scene, double motion, double growth, long steps);

/// round_off_bound() or single_precision_bound(), depending on the precision that the method's runs show
/// (which_rule.h).
std::optional<double> round_off_bound_of(const Method& method, const Scene& scene, double motion, double growth,
                                         long steps);

struct Statistic {
  std::string quantity, unit;
  double mean, deviation;  // sample standard deviation (n - 1), 0 for one run
};

struct ContactStatistics {
  static constexpr int runs = 16;
  /// Initial displacement of each particle in a seeded direction, m. It is far above rounding errors, which grow a
  /// thousandfold from 1e-16 m within the window, and at most a hundredth of the tolerance of any shipped scene with
  /// contact.
  static constexpr double perturbation = 1e-6;
};

/// Quantities of one run of a scene with contact, whose deviations are 0; the run must have recorded velocities. They
/// are the height (y) of the centre of mass, kinetic energy, elastic energy and outline (RMS distance of the free
/// particles from the vertical through their centre of mass) at the end, and the smallest clearance at any sample.
std::vector<Statistic> contact_quantities(const Scene& scene, const Trajectory& path);

/// Means and deviations of contact_quantities() over 16 perturbed runs. Empty if the method does not support the scene,
/// or if a run fails.
std::vector<Statistic> contact_statistics(const Method& method, const Scene& scene, const Run& run);

}  // namespace crosscheck
