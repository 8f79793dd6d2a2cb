// The three families. Each spring is added from only one of its ends, if there is a particle at the other end.
#include <cmath>

#include "cloth.h"

std::vector<Spring> structural(const Grid& grid, double k) {
  std::vector<Spring> springs;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const int here = index_of(grid, row, column);
      if (column + 1 < grid.columns) springs.push_back({here, index_of(grid, row, column + 1), k, grid.across});
      if (row + 1 < grid.rows) springs.push_back({here, index_of(grid, row + 1, column), k, grid.down});
    }
  return springs;
}

std::vector<Spring> shear(const Grid& grid, double k) {
  std::vector<Spring> springs;
  const double rest = std::sqrt(grid.across * grid.across + grid.down * grid.down);
  for (int row = 0; row + 1 < grid.rows; ++row)
    for (int column = 0; column + 1 < grid.columns; ++column) {
      springs.push_back({index_of(grid, row, column), index_of(grid, row + 1, column + 1), k, rest});
      springs.push_back({index_of(grid, row, column + 1), index_of(grid, row + 1, column), k, rest});
    }
  return springs;
}

std::vector<Spring> flexion(const Grid& grid, double k) {
  std::vector<Spring> springs;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const int here = index_of(grid, row, column);
      if (column + 2 < grid.columns) springs.push_back({here, index_of(grid, row, column + 2), k, 2 * grid.across});
      if (row + 2 < grid.rows) springs.push_back({here, index_of(grid, row + 2, column), k, 2 * grid.down});
    }
  return springs;
}
