// The motions that a player shows, thinned to the frames of the page.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/experiment.h"
#include "reference/truth.h"
#include "report/player/quantised.h"

namespace crosscheck {

/// The path of one method, or of the truth.
struct Shown {
  const Answer* answer = nullptr;  // none: the truth
  std::string name;
  std::vector<double> t;     // s
  std::vector<Points> x, v;  // N (3 x n), m and m/s; v is 3 x 0 where the method tells none
  bool ok() const { return !answer || answer->outcome.verdict == Verdict::ok; }
};

/// Every how many samples the page has a frame: at most 150 frames of a scene of more than 250 particles, 300 of
/// others; the last sample is one, where that is near. 0 where fewer than 25 frames would fit into the page.
int frame_stride(const Scene& scene);

/// The truth at every stride-th of its samples.
Shown shown_of(const Truth& truth, int stride);
/// The answers that have frames, then the truth, if there is one. A run that failed ends with its last frame near the
/// others.
std::vector<Shown> shown_of(const Scene& scene, const std::vector<const Answer*>& answers,
                            const std::optional<Truth>& truth);

/// The lattice of a scene's motions: around the truth, where there is one, else around those that went well.
Lattice lattice_of(const std::vector<Shown>& all);

}  // namespace crosscheck
