// The pair probe read as springs, and particles read as a grid.
#pragma once

#include <optional>
#include <vector>

#include "tests/coursework/check/case.h"

namespace coursework::classic {

struct Spring {
  int a, b;        // moving b pulls at a
  double k, rest;  // per mass of a; from the first two distances
  bool linear;     // the third distance fits, and nothing pulls across
};

struct Springs {
  int particles = 0;
  std::vector<double> x, y, z;     // where they start
  std::vector<bool> fixed, moved;  // cannot move; was moved to see whom it pulls
  std::vector<bool> still;         // at rest when it starts, or never moves
  bool repeats = false;
  std::vector<Spring> all;
};

/// Of the raw numbers of the call "springs"; no particles where they are not of its form.
Springs springs_of(const Numbers& raw);

struct Grid {
  int rows = 0, columns = 0;
  int row(int i) const { return i / columns; }
  int column(int i) const { return i % columns; }
};
/// From where the particles start, row after row; where they start in another shape, from what fits the springs best.
std::optional<Grid> grid_of(const Springs& springs);

}  // namespace coursework::classic
