// Part 1: the grid. See "The grid" in the hand-out.
#include "cloth.h"

int index_of(const Grid& /*grid*/, int /*row*/, int /*column*/) {
  return 0;  // yours
}

std::vector<int> neighbours(const Grid& /*grid*/, int /*row*/, int /*column*/) {
  return {};  // yours
}

std::vector<Vec3> positions(const Grid& grid) {
  return std::vector<Vec3>(grid.rows * grid.columns);  // yours: all are at the origin
}
