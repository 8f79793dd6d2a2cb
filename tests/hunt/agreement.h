// Agreement: two methods have the same limit as their steps go to 0, to the accuracy that halved steps show.
#pragma once

#include "experiments/check/check.h"

namespace crosscheck {

/// A row like those of the table of relations, of two methods: it has no functions of its own.
const Relation& agreement();

/// A method's best run of a scene, and a bound on the distance of its limit from that run.
struct LimitEstimate {
  Trajectory path;
  std::vector<double> bar;  // m, up to each sample; infinite from where on nothing is known
};
/// For a fixed-step rule, its run at a quarter of the step. As long as the difference d2 of a half and a quarter of the
/// step is at most 2^(1/2 - p) of that of the whole and a half, p being the order (1 where there is contact), the
/// series is taken to go on like that of C h^p, and the limit lies within three times d2 / (2^p - 1): Richardson's
/// estimate, with the factor that bars of converged truths have (reference/truth/truth.h). Twice the rounding comes on
/// top. For an adaptive rule without contact, the difference of two tolerances; for a truth its own bar, which is a
/// mean over the particles, times the root of their number. Throws CannotBeAsked and RunFailed.
LimitEstimate limit_of(Subject& subject, const Scene& scene);

/// The two limits may differ by both bars; compared as far as both are known to a hundredth of the scene's lengths. The
/// pair is called "A & B". Not asked if a method follows another law than the scene's, or fails.
Answer ask_agreement(Subject& a, Subject& b, const Scene& scene, const std::vector<KnownBreak>& known);

}  // namespace crosscheck
