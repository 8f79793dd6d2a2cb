// Scenes that are symmetric at the start, and how far they are from it later.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "mysim/scene.h"

namespace crosscheck {

/// The partners of the particles under reflection in planes through the ball's centre, across x and across z.
class Mirror {
 public:
  /// Nothing where the scene is not symmetric in both planes to 1e-12 m: places, speeds, gravity; and where wind, moved
  /// pins, several or moving balls may break the symmetry.
  static std::optional<Mirror> of(const Scene& scene);
  /// Largest distance of a particle from its partner's mirror image, m.
  double asymmetry(const Points& x) const;

 private:
  Vec3 centre_;
  std::array<std::vector<int>, 2> partner_;  // across x, across z
};

}  // namespace crosscheck
