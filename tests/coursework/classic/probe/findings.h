// Answers to the questions of forces.h, for oracles.h to judge.
#pragma once

#include <array>
#include <vector>

#include "asker.h"

namespace probe {

/// Moving b changes the v' of a.
struct Pull {
  std::size_t b, a;
  bool measured;                     // else the rest says nothing
  float at[3], along[3], across[3];  // three distances, and at each the pull of a towards b and what of it is across
};

struct Findings {
  /// By question, of each draw a row per particle:
  ///   purity   f with another state stored, the same again, f with the same state stored, change of the stored one
  ///   motion   v, x', v', and v at the start
  ///   gravity  v' at x, v' at its mirror image, both at rest
  ///   drag     the velocity w that it alone gets, and its v' at 0, w and 2 w
  std::vector<std::array<Plain, 4>> rows;
  std::size_t n = 0;       // rows of a draw: of purity entries, else particles
  double per_entry = 0;    // purity: entries that evalF returns per entry of the state
  bool repeats = true;     // evalF does
  std::vector<bool> tied;  // hang on something that is no particle
  // springs alone
  State places;                           // at the start
  std::vector<bool> fixed, still, moved;  // cannot move; at rest when it starts, or never moves; whose pull was tried
  std::vector<Pull> pulls;

  bool empty() const { return rows.empty() && places.empty(); }
  const std::array<Plain, 4>& row(std::size_t i, std::size_t draw = 0) const { return rows[draw * n + i]; }
};

}  // namespace probe
