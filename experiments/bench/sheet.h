// The scene that all engines are timed on.
#pragma once

#include "mysim/scene.h"

namespace crosscheck {

/// A sheet of n x n particles, 1 m by 1 m and 0.25 kg, flat at the start, hanging by two corners of one edge; 400, 200
/// and 20 N/m along the threads, across the cells and over two of them; drag 5/s in sum, 9.81 m/s^2, 1 s. Damped so
/// much that no wrinkle grows out of rounding: with less the error of every method would be that of chance.
Scene sheet(int n);

}  // namespace crosscheck
