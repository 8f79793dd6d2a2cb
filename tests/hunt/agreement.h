// Agreement: two methods converge to the same limit as their steps go to 0, to the accuracy that halved steps show.
#pragma once

#include "experiments/check/check.h"

namespace crosscheck {

/// A row like those of the table of relations, but for two methods and without functions of its own.
const Relation& agreement();

/// A method's best run of a scene, and a bound on its distance from the method's limit.
struct LimitEstimate {
  Trajectory path;
  std::vector<double> bar;  // m, up to each sample; infinite where nothing is known
};
/// For a fixed-step rule, the best run is that at a quarter of the step. Let d1 be the distance between the runs at the
/// whole and half the step, d2 that between the runs at half and a quarter of the step, and p the order (1 with
/// contact). If d2 <= 2^(1/2 - p) d1, the error is assumed to behave like C h^p. The limit is then within three times
/// d2 / (2^p - 1) (Richardson's estimate; the factor is that of converged truths, reference/truth/truth.h), plus twice
/// the rounding. For an adaptive rule without contact, the bound is the distance between the runs at two tolerances,
/// plus rounding. For a truth, it is the error bar, a mean over the particles, times the square root of their number.
/// Throws CannotBeAsked and RunFailed.
LimitEstimate limit_of(Subject& subject, const Scene& scene);

/// Checks that the two limits differ by at most the sum of both bounds, as long as both bounds are at most a hundredth
/// of the scene's lengths. The pair is called "A & B". Not applicable if a method follows a different law from the
/// scene's, or fails.
Answer ask_agreement(Subject& a, Subject& b, const Scene& scene, const std::vector<KnownBreak>& known);

}  // namespace crosscheck
