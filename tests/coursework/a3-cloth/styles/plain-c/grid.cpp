// Plain loops and counters.
#include "cloth.h"
using namespace std;

int index_of(const Grid& grid, int row, int column) {
  int n = 0;
  for (int i = 0; i < row; i++) n += grid.columns;
  return n + column;
}

vector<int> neighbours(const Grid& grid, int row, int column) {
  vector<int> result;
  int me = index_of(grid, row, column);
  if (column != grid.columns - 1) result.push_back(me + 1);
  if (column != 0) result.push_back(me - 1);
  if (row != grid.rows - 1) result.push_back(me + grid.columns);
  if (row != 0) result.push_back(me - grid.columns);
  return result;
}

vector<Vec3> positions(const Grid& grid) {
  vector<Vec3> x;
  Vec3 start = grid.corner;
  for (int i = 0; i < grid.rows; i++) {
    Vec3 p = start;
    for (int j = 0; j < grid.columns; j++) {
      x.push_back(p);
      p.x += grid.across;
    }
    start.z += grid.down;
  }
  return x;
}
