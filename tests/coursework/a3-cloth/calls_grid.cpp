// Calls of part 1. The input of each begins with a grid.
#include <algorithm>

#include "calls_read.h"

namespace coursework {

/// index: the number of each particle, row by row.
/// neighbours: for each particle, the number of neighbours, then the first four in ascending order, padded with -1.
/// positions: x, y, z of each particle.
bool answer_grid(const std::string& call, const Numbers& in, Numbers& out) {
  if (call != "index" && call != "neighbours" && call != "positions") return false;
  Reader reader(in);
  const Grid grid = read_grid(reader);
  if (call == "positions") {
    put(out, positions(grid));
    return true;
  }
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      if (call == "index") {
        out.push_back(index_of(grid, row, column));
        continue;
      }
      std::vector<int> beside = neighbours(grid, row, column);
      std::sort(beside.begin(), beside.end());
      out.push_back(static_cast<double>(beside.size()));
      beside.resize(4, -1);
      out.insert(out.end(), beside.begin(), beside.end());
    }
  return true;
}

}  // namespace coursework
