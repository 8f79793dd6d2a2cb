// The result of the pair probe as springs, and the particles as a grid.
#pragma once

#include <optional>
#include <vector>

#include "tests/coursework/check/case.h"
#include "tests/coursework/classic/probe/findings.h"

namespace coursework::classic {

struct Spring {
  int a, b;        // moving b changes the pull on a
  double k, rest;  // per mass of a; from the first two distances
  bool linear;     // the third distance fits, and there is no transverse pull
  bool measured;   // otherwise the last three members are meaningless
  probe::Pull as_found;
};

struct Springs {
  int particles = 0;
  probe::State places;                    // at the start
  std::vector<bool> fixed, still, moved;  // probe/findings.h
  std::vector<bool> anchors;  // fixed particles, or, if there are none, those attached to fixed points in space
  std::vector<Spring> all;
};

/// Springs from the question "springs"; no particles if it returned nothing.
Springs springs_of(const probe::Findings& found);

struct Grid {
  int rows = 0, columns = 0;
  int row(int i) const { return i / columns; }
  int column(int i) const { return i % columns; }
};
/// True if a spring between the two would be structural, shear or flexion.
bool of_a_family(const Grid& grid, int a, int b);
/// Grid of the particles by their initial positions, row by row; if they start in another shape, the grid that fits the
/// springs best.
std::optional<Grid> grid_of(const Springs& springs);

}  // namespace coursework::classic
