// Runs of a stability map, for a click on their cells: departures from rest, a few shapes whose sizes change from
// picture to picture, which is all that a run near its limit does.
#pragma once

#include <string>

#include "experiments/experiment.h"

namespace crosscheck {

/// JSON of one method's cells, in their order; null for a cell with fewer than two pictures. A cell is
/// [row of `rests`, pictures, s between them, s of the last, magnification, metres of a unit of each shape]: the
/// departure of coordinate i in picture f is the sum over its shapes k of metres_k * paths[f] * shapes[i], where
/// `shapes` and `paths` hold those of all cells one after the other. Shapes are as many as leave out less than a
/// hundredth of the largest departure; pictures end where something has moved by twice the scene's size. Departures too
/// small to be seen are to be drawn larger by `magnification`, so that the largest is a third of the shortest spring.
std::string cell_motions_json(const WatchedRuns& watched);

}  // namespace crosscheck
