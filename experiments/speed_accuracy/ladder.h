// The steps and tolerances at which a method is tried on a scene.
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

/// Fixed steps, halved from 8 times the run's step down to a 16th of it; rules without a finite stability limit, and
/// those of which none is known, begin at 64 times. Steps longer than the sampling interval are one and the same: that
/// one. Tolerances from 1e-2 to 1e-8 (full: 1e-10). Left out is what, by an estimate that is the same on every machine,
/// would take more than 0.35 s of CPU time (1.2 s at the run's own step and longer ones; full: 1.5 s at all); `dropped`
/// counts those.
std::vector<Setting> ladder(const Method& method, const Scene& scene, const Run& run, bool full,
                            int* dropped = nullptr);

}  // namespace crosscheck
