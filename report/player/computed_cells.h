// Cells of maps that the page computes itself: where the engine stands in the page, their pictures need not.
//
// All cells of a map's row start from one state, a rest that was perturbed. The page has it on lattices whose steps are
// powers of two: rests in 48 bits, what the perturbation moved and its velocities in 32, so that the page begins with
// the same bits as the check here. What the rounding of the start, or other instructions, change by more than a picture
// tells stays stored: that is told by a run of the engine with the lanes of the page.
#pragma once

#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "experiments/experiment.h"
#include "experiments/stability/map.h"
#include "mysim/base/json.h"

namespace crosscheck {

/// Numbers as whole multiples of a step, in words of 16 bits.
class WordLattice {
 public:
  explicit WordLattice(int words) : words_(words) {}
  /// The largest number that it has: a bit is the sign's, one is for rounding.
  double most() const { return std::exp2(16 * words_ - 2); }
  /// Appends values and makes them what they are on the lattice.
  void take(Points& values, double step);
  /// The lowest words of all numbers, then the next.
  Json json() const;

 private:
  int words_;
  std::array<std::vector<std::uint16_t>, 3> numbers_;
};

class CellStarts {
 public:
  /// Whether cells of a method are computed: rules of mysim's that have the same bits in every build.
  static bool are_taken(const std::string& method);

  /// The rests are those of the cells, each once, in their order.
  CellStarts(const RecordedRuns& recorded, const std::vector<Points>& rests);

  /// {"modes", "frames", "computed", "row", "h" (step, s), "first", "apart" (steps to the first picture, and from one
  /// to the next)} of a cell whose first pictures (m) the page shows within so many metres; nothing where it would not.
  std::optional<Json> reproduced(const RecordedRun& run, const std::vector<Points>& pictures, double within);

  /// {"kind", "samples", "steps", "rest" (m, of one), "rests", "moves": packed numbers, "rows": [{"value", "at" (of the
  /// rest), "move" (m), "speed" (m/s), of one}]}. Rests: the lower 16 bits of all coordinates, then the upper ones.
  /// Moves: of each row what places are apart from the rest, then velocities, where the scene has them.
  Json json() const;

  /// The scene of a cell as the page opens it.
  Scene scene_of(const MapCell& cell);

 private:
  struct Row {
    double value, move, speed;
    size_t at;
    Scene scene;
  };
  Row& row_of(const MapCell& cell);

  const Scene& scene_;
  std::string rule_;
  const MapKind* kind_ = nullptr;
  long steps_ = 0;              // of each run
  int samples_ = 0;             // of each run
  double rest_ = 1;             // m, of one
  std::vector<Points> rests_;   // m, given
  std::vector<Points> placed_;  // m, on the lattice
  WordLattice rest_numbers_{3}, moves_{2};
  std::vector<Row> rows_;
};

}  // namespace crosscheck
