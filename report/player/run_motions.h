// Motions of single runs, for a click in a figure: on markers of work-precision diagrams, on cells of stability maps.
#pragma once

#include <string>

#include "experiments/experiment.h"
#include "reference/truth/truth.h"

namespace crosscheck {

// Runs of a speed-accuracy chart, for a click on their markers: packed as differences from the truth that the scene's
// own player has already. A run as good as the truth weighs next to nothing.

/// JSON of one method's runs, in their order. Of a run that came to its end there is every `every`-th frame of the
/// scene's player: numbers on the truth's lattice (packed_numbers.h) less the truth's own, counted in grains of so many
/// units; plotted are exponents of ten of the RMS distance from the truth (m), while single places can be compared. Of
/// one that failed there are the last pictures, with times and a lattice of their own; plotted are exponents of ten of
/// the kinetic energy (J). Null where there is nothing to show. `call` has the options of `run` for the same run. Empty
/// when the scene has no player (thinned_trajectory.h) or no truth.
std::string run_motions_json(const WatchedRuns& watched, const std::optional<Truth>& truth);

// Runs of a stability map, for a click on their cells: departures from rest, a few shapes that change in size from
// picture to picture, which is all that a run near its limit does.

/// JSON of one method's cells, in their order; null for a cell with fewer than two pictures. A cell is
/// [row of `rests`, pictures, s between them, s of the last, magnification, metres of a unit of each shape]: the
/// departure of coordinate i in picture f is the sum over its shapes k of metres_k * paths[f] * shapes[i], where
/// `shapes` and `paths` hold those of all cells one after the other. Shapes are as many as leave out less than a
/// hundredth of the largest departure; pictures end where something has moved by twice the scene's size. Departures too
/// small to be seen are to be drawn larger by `magnification`, so that the largest is a third of the shortest spring.
std::string cell_motions_json(const WatchedRuns& watched);

}  // namespace crosscheck
