// Runs of a speed-accuracy chart, for a click on their markers: packed as differences from the truth that the scene's
// own player has already. A run as good as the truth weighs next to nothing.
#pragma once

#include <string>

#include "experiments/experiment.h"
#include "reference/truth.h"

namespace crosscheck {

/// JSON of one method's runs, in their order; null for a run without frames. Numbers are those of QuantisedPlaces on
/// the truth's lattice, less the truth's own of that frame, with sums that wrap at 2^16; lattice numbers run from
/// -24576 to 40959. Every `every`-th frame of the scene's player is there, until a run leaves the picture.
/// Empty when the scene has no player (shown.h) or no truth.
std::string run_motions_json(const WatchedRuns& watched, const std::optional<Truth>& truth);

}  // namespace crosscheck
