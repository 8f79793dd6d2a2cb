// The hunter: draws random scenes, asks methods for relations and pairs of methods for agreement on them, and makes
// each scene that shows a break as small as it goes.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "experiments/check/agreement.h"
#include "experiments/check/draft.h"
#include "experiments/experiment.h"
#include "experiments/tables/check.h"

namespace crosscheck {

// Scenes drawn at random (draw.cpp).

/// Case `index` of a seed: a function of both and of nothing else. 1 to 30 particles, in steps of at most a twentieth
/// of what is stable; every index modulo drawn_kinds is another kind of scene, so that each relation is asked.
struct DrawnCase {
  unsigned seed;
  long index;
  SceneDraft draft;
};
DrawnCase draw(unsigned seed, long index);
inline constexpr int drawn_kinds = 12;

// The smallest scene that still shows something (shrink.cpp).

using StillShows = std::function<bool(const Scene&)>;
struct Shrunk {
  SceneDraft draft;
  int trials = 0;  // scenes that were asked
};
/// Delta debugging: leaves out ingredients, particles, springs and pins, shortens time, and rounds numbers to few
/// digits, as long as `shows` is true of what remains, until nothing more goes or so many scenes were asked. The scenes
/// that `shows` is given are those that the file will be read as. The same arguments give the same scene.
Shrunk shrink(const SceneDraft& draft, const StillShows& shows, int most_trials);

// Findings.

/// Everything that a case depends on beside its number.
struct Hunt {
  std::vector<Method> methods;
  std::vector<KnownBreak> known;
  unsigned seed = 1;
  /// Of turns, shifts and orders on a case: another on each.
  unsigned seed_of(long index) const { return seed + static_cast<unsigned>(index); }
  /// So many scenes are asked to make one smaller, at most: half of them leave out what a scene of thirty particles
  /// has, and the others round its numbers.
  int most_trials = 400;
};

/// What was broken on a case: a row of the smallest scene, and a row of what was asked.
void compute_case(const Hunt& hunt, const DrawnCase& drawn, TableSet& tables);
/// The case as a point of a sweep.
Point point_of(const Hunt& hunt, long index);

/// Rows of one relation, the same methods and the same kind of scene: one fault, as far as can be told.
struct FindingGroup {
  HuntFindingRow smallest;  // fewest particles, then shortest file
  int cases = 0;
};
/// In the order of their first cases; unknown ones first.
std::vector<FindingGroup> grouped(std::span<const HuntFindingRow> rows);

}  // namespace crosscheck
