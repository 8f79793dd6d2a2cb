// Runs of a speed-accuracy chart, for a click on their markers: packed as differences from the truth that the scene's
// own player has already. A run as good as the truth weighs next to nothing.
#pragma once

#include <string>

#include "experiments/experiment.h"
#include "reference/truth.h"

namespace crosscheck {

/// JSON of one method's runs, in their order. Of a run that came to its end there is every `every`-th frame of the
/// scene's player: numbers on the truth's lattice (quantised.h) less the truth's own, counted in grains of so many
/// units; plotted are exponents of ten of the RMS distance from the truth (m), while single places can be compared. Of
/// one that failed there are the last pictures, with times and a lattice of their own; plotted are exponents of ten of
/// the kinetic energy (J). Null where there is nothing to show. `call` has the options of `run` for the same run. Empty
/// when the scene has no player (shown.h) or no truth.
std::string run_motions_json(const WatchedRuns& watched, const std::optional<Truth>& truth);

}  // namespace crosscheck
