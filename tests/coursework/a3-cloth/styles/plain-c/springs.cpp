// Plain loops: rows first, then columns.
#include <cmath>
#include <iostream>

#include "cloth.h"
using namespace std;

static void connect(vector<Spring>& springs, int a, int b, double k, double rest) {
  Spring s;
  s.a = a;
  s.b = b;
  s.k = k;
  s.rest = rest;
  springs.push_back(s);
}

// springs to the particle `skip` positions away, along rows and along columns
static vector<Spring> straight(const Grid& g, double k, int skip) {
  vector<Spring> springs;
  for (int i = 0; i < g.rows; i++)
    for (int j = skip; j < g.columns; j++)
      connect(springs, index_of(g, i, j), index_of(g, i, j - skip), k, skip * g.across);
  for (int j = 0; j < g.columns; j++)
    for (int i = skip; i < g.rows; i++) connect(springs, index_of(g, i - skip, j), index_of(g, i, j), k, skip * g.down);
  cout << "made " << springs.size() << " springs\n";
  return springs;
}

vector<Spring> structural(const Grid& grid, double k) { return straight(grid, k, 1); }
vector<Spring> flexion(const Grid& grid, double k) { return straight(grid, k, 2); }

vector<Spring> shear(const Grid& grid, double k) {
  vector<Spring> springs;
  for (int i = 0; i < grid.rows; i++)
    for (int j = 0; j < grid.columns; j++) {
      if (i == grid.rows - 1) continue;
      if (j < grid.columns - 1)
        connect(springs, index_of(grid, i, j), index_of(grid, i + 1, j + 1), k, hypot(grid.across, grid.down));
      if (j > 0) connect(springs, index_of(grid, i, j), index_of(grid, i + 1, j - 1), k, hypot(grid.across, grid.down));
    }
  return springs;
}
