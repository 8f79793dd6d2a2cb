// The run loop of worlds that choose their own steps, whoever integrates.
#pragma once

#include "mysim/march.h"

namespace crosscheck {

/// Marches the world and fills what adaptive methods report besides: evaluations, steps accepted, their mean and the
/// tolerance. The fixed step of the run is only the grid on which observers of every step look (and, where
/// keep_grid says so, what bounds the world's own steps).
template <class AdaptiveWorld>  // a World with right_hand_side() and accepted()
Outcome march_adaptively(AdaptiveWorld& world, const Run& run, Observer& observer, bool keep_grid = false) {
  Run seen = run;
  if (!observer.every_step() && !keep_grid) seen.step = run.duration / run.samples;
  Outcome out = march(world, seen, observer);
  out.evaluations = world.right_hand_side().evaluations();
  out.coincident = world.right_hand_side().coincident();
  out.steps = world.accepted();
  out.step = out.steps > 0 ? out.end / static_cast<double>(out.steps) : 0;
  out.tolerance = run.tolerance;
  return out;
}

}  // namespace crosscheck
