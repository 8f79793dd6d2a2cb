// Answers to the questions of forces.h, which oracles.cpp judges.
#pragma once

#include <array>
#include <vector>

#include "asker.h"

namespace probe {

/// Moving b changes v' of a.
struct Pull {
  std::size_t b, a;
  bool measured;                     // otherwise the other members are meaningless
  float at[3], along[3], across[3];  // three distances; for each, the pull on a towards b, and the pull across
};

struct Findings {
  /// Rows of each question; each draw has a row per particle:
  ///   purity   f with another stored state, f again, f with the same state stored, change of the stored state
  ///   motion   v, x', v', and v at the start
  ///   gravity  v' at x, v' at its mirror image, both at rest
  ///   drag     a velocity w of this particle alone, its v' at 0 and w, and at 2 w while all others have w
  std::vector<std::array<Plain, 4>> rows;
  std::size_t n = 0;       // rows of a draw: entries for purity, otherwise particles
  double per_entry = 0;    // purity: entries that evalF returns per entry of the state
  bool repeats = true;     // evalF is deterministic
  std::vector<bool> tied;  // particles attached to something that is not a particle
  // only for the question "springs"
  State places;                           // initial positions
  std::vector<bool> fixed, still, moved;  // immobile; at rest at the start, or always; moved by the probe
  std::vector<Pull> pulls;

  bool empty() const { return rows.empty() && places.empty(); }
  const std::array<Plain, 4>& row(std::size_t i, std::size_t draw = 0) const { return rows[draw * n + i]; }
};

}  // namespace probe
