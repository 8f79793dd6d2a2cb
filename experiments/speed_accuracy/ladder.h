// The steps and tolerances at which a method is tried on a scene, and what is timed of each run.
#pragma once

#include <string>
#include <vector>

#include "reference/method.h"

namespace crosscheck {

struct Setting {
  bool tolerance;  // else a step
  double value;    // s; tolerances 1
  /// The run at this setting.
  Run applied_to(Run run) const;
};

/// Fixed steps, halved from 64 times the run's step down to a 16th of it; of those above 8 times only what is at most
/// twice the limit of a rule whose limit is known. Steps longer than the sampling interval are one and the same: that
/// one. Tolerances from 1e-2 to 1e-8 (full: 1e-10). Left out is what, by an estimate that is the same on every machine,
/// would take more than 0.35 s of CPU time (1.8 s at the run's own step and longer ones); without `full` 0.7 times as
/// much. `dropped` counts those.
std::vector<Setting> ladder(const Method& method, const Scene& scene, const Run& run, bool full,
                            int* dropped = nullptr);

/// What is timed of a run: the whole, or its first part.
struct TimedPart {
  Run run;
  double share = 1;  // of the run's steps or samples
};
/// As much as takes about 20 ms by the estimate, or, of adaptive methods, by how the run begins. The whole run where
/// something may be touched (that may cost more than falling), and of outside programs.
TimedPart part_of(const Method& method, const Scene& scene, const Run& base, const Setting& setting);

}  // namespace crosscheck
