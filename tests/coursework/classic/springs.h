// The springs found by the pair probe, and the grid of the particles.
#pragma once

#include <optional>
#include <vector>

#include "tests/coursework/check/case.h"
#include "tests/coursework/classic/probe/findings.h"

namespace coursework::classic {

struct Spring {
  int a, b;        // moving b changes the pull on a
  double k, rest;  // stiffness per mass of a, and rest length; from the first two distances
  bool linear;     // the pull at the third distance fits, and there is no transverse pull
  bool measured;   // otherwise k, rest and linear are meaningless
  probe::Pull as_found;
};

struct Springs {
  int particles = 0;
  probe::State places;                    // at the start
  std::vector<bool> fixed, still, moved;  // probe/findings.h
  std::vector<bool> anchors;  // fixed particles, or, if there are none, those attached to fixed points in space
  std::vector<Spring> all;
};

/// Springs from the question "springs"; contains no particles if the probe returned nothing.
Springs springs_of(const probe::Findings& found);

struct Grid {
  int rows = 0, columns = 0;
  int row(int i) const { return i / columns; }
  int column(int i) const { return i % columns; }
};
/// True if a spring between a and b would be structural, shear or flexion.
bool of_a_family(const Grid& grid, int a, int b);
/// Grid of the particles by their initial positions, row by row. If the positions form no grid, returns the grid that
/// fits the springs best.
std::optional<Grid> grid_of(const Springs& springs);

}  // namespace coursework::classic
