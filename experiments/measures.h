// Measures of a scene: its state of rest, sag, period, settling time and largest stretch.
#pragma once

#include <optional>
#include <string>

#include "mysim/scene/scene.h"

namespace crosscheck {

/// The state of rest under gravity, springs and steady winds, with the pins in their initial places. Uses dynamic
/// relaxation with kinetic damping: sets all velocities to zero at each peak of the kinetic energy, until the RMS
/// acceleration of the free particles is 1e-5 of its largest value. Omits drag, which does not affect the rest. Returns
/// nullopt if there is no rest after a hundred thousand steps, and for first-order scenes, hard distances, spheres,
/// gusts, moving pins and scenes without pins.
std::optional<State> rest_of(const Scene& scene);

enum class MeasuredBy {
  one_run,         // one run of leapfrog, accurate to a few per cent
  converged_runs,  // runs of leapfrog with halved steps, extrapolated until the change is below 1e-4 of the measure
  own_method,      // the scene's method at its step, as in `crosscheck run`
};

/// Largest displacement of a particle along gravity between the start and the state of rest, m. Returns nullopt if
/// rest_of() finds no rest.
std::optional<double> sag_of(const Scene& scene);

/// Period of the slowest visible oscillation of the centre of mass of the free particles, s (see period_of_path()).
/// `about`: the expected period, s. Returns nullopt if there are fewer than three turning points in 72 times this
/// period.
std::optional<double> period_of(const Scene& scene, double about, MeasuredBy by = MeasuredBy::converged_runs);

/// Time (s) after which the mechanical energy (kinetic, elastic and gravitational) exceeds the energy at rest by less
/// than a thousandth of its largest excess. `about`: the expected time, s; results beyond 1.5 times this time are
/// extrapolated exponentially. Returns nullopt if there is no state of rest.
std::optional<double> settle_time_of(const Scene& scene, double about, MeasuredBy by = MeasuredBy::converged_runs);

/// Largest strain (L - r) / r of any spring during the scene, 1. Returns nullopt if no spring has a rest length.
std::optional<double> max_stretch_of(const Scene& scene, MeasuredBy by = MeasuredBy::converged_runs);

}  // namespace crosscheck
