// The pair probe read as springs, and particles read as a grid.
#pragma once

#include <optional>
#include <vector>

#include "tests/coursework/check/case.h"
#include "tests/coursework/classic/probe/findings.h"

namespace coursework::classic {

struct Spring {
  int a, b;        // moving b pulls at a
  double k, rest;  // per mass of a; from the first two distances
  bool linear;     // the third distance fits, and nothing pulls across
  bool measured;   // else the last three say nothing
  probe::Pull as_found;
};

struct Springs {
  int particles = 0;
  bool repeats = false;
  probe::State places;                    // at the start
  std::vector<bool> fixed, still, moved;  // probe/findings.h
  std::vector<bool> anchors;  // the fixed ones; where there are none, those that hang on something in the world
  std::vector<Spring> all;
};

/// Springs from the question "springs"; no particles if it found nothing.
Springs springs_of(const probe::Findings& found);

struct Grid {
  int rows = 0, columns = 0;
  int row(int i) const { return i / columns; }
  int column(int i) const { return i % columns; }
};
/// True if a spring between the two would be structural, shear or flexion.
bool of_a_family(const Grid& grid, int a, int b);
/// From where the particles start, row after row; where they start in another shape, from what fits the springs best.
std::optional<Grid> grid_of(const Springs& springs);

}  // namespace coursework::classic
