// The hunt: draws random scenes, checks relations of methods and the agreement of each pair of methods on them, and
// shrinks every scene that shows a violation.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tests/hunt/agreement.h"
#include "tests/hunt/draft.h"

namespace crosscheck {

/// Draws a scene that depends only on seed and index: 1 to 30 particles, with steps of at most a twentieth of the
/// stability limit. The index modulo drawn_kinds selects the kind of scene, so that every relation applies to some.
SceneDraft draw(unsigned seed, long index);
inline constexpr int drawn_kinds = 12;

using StillShows = std::function<bool(const Scene&)>;
struct Shrunk {
  SceneDraft draft;
  int trials = 0;
};
/// Delta debugging: removes ingredients, particles, springs and pins, shortens the duration, and rounds numbers to few
/// digits, as long as `shows` is true for the result, until nothing more can be removed or `most_trials` scenes were
/// tried. `shows` gets each scene as read from its file. The result depends only on the arguments.
Shrunk shrink(const SceneDraft& draft, const StillShows& shows, int most_trials);

struct Hunt {
  std::vector<Method> methods;
  std::vector<KnownBreak> known;
  unsigned seed = 1;
  int most_trials = 400;  // per shrinking: half of the trials remove parts, the others round numbers

  /// Seed of the random rotations, translations and orders for the scene `index`.
  unsigned seed_of(long index) const { return seed + static_cast<unsigned>(index); }
};

/// A violated relation, or a disagreement of two methods, on the smallest scene found.
struct Break {
  Answer answer;
  Shrunk smallest;
};
/// The violations of case `index` that are not known breaks. Increases `answers` by the number of relations that were
/// measured.
std::vector<Break> breaks_of(const Hunt& hunt, long index, int& answers);

}  // namespace crosscheck
