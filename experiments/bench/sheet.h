// The scene that all engines are timed on.
#pragma once

#include "mysim/scene.h"

namespace crosscheck {

/// N/m: along the threads, across the cells, over two of them.
struct Threads {
  double structural = 400, shear = 200, bend = 20;
};

/// A sheet of n x n particles, 1 m by 1 m and 0.25 kg, flat at the start, hanging by two corners of one edge; drag 5/s
/// in sum, 9.81 m/s^2, 1 s. Damped so much that no wrinkle grows out of rounding: with less the error of every method
/// would be that of chance. Its step is below every explicit rule's limit.
Scene sheet(int n, const Threads& threads = {});

/// The same with as much stiffness across the cells as along the threads: two stiffnesses in all, which Bullet's own
/// spring force can carry.
Scene sheet_of_two_stiffnesses(int n);

/// The same with the law of Bullet's position-based links in place of Hooke's (terms/springs.h): what they converge to,
/// so that their error can be told from their model.
Scene sheet_of_links(int n);

}  // namespace crosscheck
