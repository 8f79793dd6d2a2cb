// Plain measures of a scene: its state of rest, sag, period, settling time and largest stretch.
#pragma once

#include <optional>
#include <string>

#include "mysim/scene/scene.h"

namespace crosscheck {

/// The state of rest under gravity, springs and steady winds, pins where they stand at the start: found by dynamic
/// relaxation with kinetic damping (all velocities are set to zero at each peak of the kinetic energy; drag is left
/// out, as it does not move the rest), until the RMS acceleration of the free particles is 1e-5 of what moves them.
/// Nothing where there is no rest to find: first-order scenes, hard distances, spheres, gusts, moving pins, nothing
/// pinned, or no rest within a hundred thousand steps.
std::optional<State> rest_of(const Scene& scene);

// Plain measures of a scene: what a [wish] is about.

/// The runs from which a measure is taken.
enum class MeasuredBy {
  one_run,         // one run of leapfrog, to a few per cent
  converged_runs,  // leapfrog at halved steps, extrapolated until the measure changes by less than 1e-4 of itself
  own_method,      // the scene's method at its step, as `run` does
};

/// m: how far the particle that sank most hangs below its place at the start, along gravity, when the scene has come
/// to rest (measures.h). Nothing where there is no such rest.
std::optional<double> sag_of(const Scene& scene);

/// s: period of the slowest visible oscillation of the centre of mass of the free particles: twice the mean time
/// between turning points of its path, seen along the direction in which it moves most; a turning point counts when
/// the path turns back by a tenth of its whole range or more. Nothing where fewer than three are seen in 72 times
/// `about` (s), the period that is expected.
std::optional<double> period_of(const Scene& scene, double about, MeasuredBy by = MeasuredBy::converged_runs);

/// s: when the mechanical energy above that at rest (kinetic, elastic and gravitational) has fallen to a thousandth of
/// its largest value for good; beyond 1.5 times `about` (s) as an exponential decay from there on would. Nothing
/// without a rest.
std::optional<double> settle_time_of(const Scene& scene, double about, MeasuredBy by = MeasuredBy::converged_runs);

/// 1: the largest strain (L - r) / r of any spring in the scene's duration. Nothing without springs of a rest length.
std::optional<double> max_stretch_of(const Scene& scene, MeasuredBy by = MeasuredBy::converged_runs);

}  // namespace crosscheck
