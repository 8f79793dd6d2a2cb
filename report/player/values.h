// What colours and the plot show of motions: stretch, distance from the truth, energy.
#pragma once

#include <optional>
#include <vector>

#include "report/player/shown.h"

namespace crosscheck {

/// Values of the particles of several motions on one scale from 0 to top.
struct ColourValues {
  std::vector<std::vector<double>> of;  // for each motion: frames x particles; perhaps of its first frames alone
  double top = 0;  // a round number that no run that went well exceeds; 0: there is nothing to show
};

/// Mean extension of the springs at each particle, %.
ColourValues stretch_values(const Scene& scene, const std::vector<Shown>& all);

/// Distances of the particles from those of the truth, mm, up to `until` (s). Nothing where all of them lie below its
/// error bar (m).
ColourValues distance_values(const std::vector<Shown>& all, const Shown& truth, double until, double bar);

/// Total energy in each frame, J; of a first-order scene the RMS distance from the truth, mm. Empty where unknown.
std::vector<std::optional<double>> plotted_values(const Scene& scene, const Shown& shown, const Shown* truth);

}  // namespace crosscheck
