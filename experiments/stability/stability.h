// The largest stable step of one method on one scene, as a row.
#pragma once

#include "experiments/point.h"
#include "experiments/stability/trial.h"

namespace crosscheck {

/// What a search is worth.
struct Effort {
  long steps;        // of each run
  double precision;  // at which halving ends
};
/// Quick: fine on small scenes, coarse where each step solves an equation. Full: as fine as about 5 s of CPU time pay
/// for.
Effort effort_for(const Method& method, const Scene& scene, bool full);

/// Small scenes cost so little that every method is asked on them, and finely.
inline bool is_small(const Scene& scene) { return scene.start.x.cols() <= 50; }

/// A row of table stability, and rows of stability-growth where steps multiply modes.
void limit_on(const Scene& scene, const Method& method, const Effort& effort, Rows& rows);

}  // namespace crosscheck
