// The grid: indices, neighbours, positions.
#include "cloth.h"

int index_of(const Grid& grid, int row, int column) { return row * grid.columns + column; }

std::vector<int> neighbours(const Grid& grid, int row, int column) {
  std::vector<int> beside;
  if (row > 0) beside.push_back(index_of(grid, row - 1, column));
  if (row + 1 < grid.rows) beside.push_back(index_of(grid, row + 1, column));
  if (column > 0) beside.push_back(index_of(grid, row, column - 1));
  if (column + 1 < grid.columns) beside.push_back(index_of(grid, row, column + 1));
  return beside;
}

std::vector<Vec3> positions(const Grid& grid) {
  std::vector<Vec3> x;
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column)
      x.push_back(grid.corner + Vec3(column * grid.across, 0, row * grid.down));
  return x;
}
