// Whether two methods have the same limit as their steps go to 0: each is as far from it as its own halved steps show.
#pragma once

#include "experiments/check/check.h"

namespace crosscheck {

/// A row like those of the table of relations, of two methods: it has no functions of its own.
const Relation& agreement();

/// "A & B": how a pair stands in tables and in lists of known breaks.
std::string pair_name(const Method& a, const Method& b);
/// Those of the methods that the name is of: one, or both of a pair.
std::vector<Method> methods_named(const std::string& name, const std::vector<Method>& methods);

/// The best that a method says of a scene, and how far its limit may be from that.
struct LimitEstimate {
  Trajectory path;
  std::vector<double> bar;  // m, up to each sample; infinite from where on nothing can be said
};
/// Of a fixed-step rule its run at a quarter of the step. As long as the difference d2 of a half and a quarter of the
/// step is at most 2^(1/2 - p) of that of the whole and a half, p being the order (1 where there is contact), the
/// series is taken to go on like that of C h^p, and the limit lies within three times d2 / (2^p - 1): Richardson's
/// estimate, with the factor that bars of converged truths have (reference/truth/truth.h). Twice the rounding comes on
/// top. Of an adaptive rule without contact the difference of two tolerances; of a truth its own bar, which is a mean
/// over the particles, times the root of their number. Throws CannotBeAsked and RunFailed.
LimitEstimate limit_of(Subject& subject, const Scene& scene);

/// Where both are known to a hundredth of the lengths in the scene, the two limits may differ by both bars. Cannot be
/// asked where a method follows another law than the scene's, or fails: relations of its own tell that.
Answer ask_agreement(Subject& a, Subject& b, const Scene& scene, const std::vector<KnownBreak>& known);

}  // namespace crosscheck
