// Trajectories thinned to the frames of the page, with what colours, plot and words show of them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "experiments/experiment.h"
#include "mysim/base/json.h"
#include "reference/truth/truth.h"
#include "report/player/packed_numbers.h"

namespace crosscheck {

/// The path of one method, or of the truth.
struct ThinnedTrajectory {
  const Result* answer = nullptr;  // none: the truth
  std::string name;
  std::vector<double> t;     // s
  std::vector<Points> x, v;  // N (3 x n), m and m/s; v is 3 x 0 where the method reports none
  bool ok() const { return !answer || answer->outcome.verdict == Verdict::ok; }
};

/// Every how many samples the page has a frame: at most 150 frames of a scene of more than 250 particles, 300 of
/// others; the last sample is one, where that is near. 0 where fewer than 25 frames would fit into the page.
int frame_stride(const Scene& scene);

/// The truth at every stride-th of its samples.
ThinnedTrajectory thin(const Truth& truth, int stride);
/// The results that have frames, then the truth, if there is one. A run that failed ends with its last frame near the
/// others.
std::vector<ThinnedTrajectory> thin(const Scene& scene, const std::vector<const Result*>& answers,
                                    const std::optional<Truth>& truth);

/// The lattice of a scene's motions: around the truth, where there is one, else around those that went well.
Lattice lattice_of(const std::vector<ThinnedTrajectory>& all);

// Values of motions for colours and the plot: stretch, distance from the truth, energy.

/// Values of the particles of several motions on one scale from 0 to top.
struct ColourValues {
  std::vector<std::vector<double>> of;  // for each motion: frames x particles; perhaps of its first frames alone
  double top = 0;  // a round number that no run that went well exceeds; 0: there is nothing to show
};

/// Mean extension of the springs at each particle, %.
ColourValues stretch_values(const Scene& scene, const std::vector<ThinnedTrajectory>& all);

/// Distances of the particles from those of the truth, mm, up to `until` (s). Nothing where all of them lie below its
/// error bar (m).
ColourValues distance_values(const std::vector<ThinnedTrajectory>& all, const ThinnedTrajectory& truth, double until,
                             double error_bar);

/// Total energy in each frame, J; of a first-order scene the RMS distance from the truth, mm. Empty where unknown.
std::vector<std::optional<double>> plotted_values(const Scene& scene, const ThinnedTrajectory& shown,
                                                  const ThinnedTrajectory* truth);

/// Name, looks and what became of it: "name", "colour", "dash", "stops" (s), "failed" (s or null), "failure", "reason",
/// "note" (of different laws), "end", and "known": whether it is the truth.
Json motion_info_json(const ThinnedTrajectory& shown);

}  // namespace crosscheck
