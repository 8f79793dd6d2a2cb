// Scenes derived from others by rotation, translation, reflection, renumbering and scaling; and the smallest scenes
// that can show the relations.
#pragma once

#include <optional>
#include <vector>

#include "mysim/scene/scene.h"

namespace crosscheck {

/// The map x' = turn x + shift, where `turn` is orthogonal.
struct Placement {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  Vec3 shift = Vec3::Zero();  // m

  Points of(const Points& x) const { return ((turn * x).colwise() + shift).eval(); }
};
/// A uniformly distributed rotation, reproducible by its seed.
Eigen::Matrix3d seeded_turn(unsigned seed);
/// The numbers 0 to n - 1 in a seeded order in which no number keeps its position.
std::vector<int> seeded_order(int n, unsigned seed);

/// The scene with all directions and positions transformed.
Scene placed(Scene scene, const Placement& placement);

/// The scene with particle `order[i]` renumbered to i.
Scene renumbered(const Scene& scene, const std::vector<int>& order);
/// Springs, bending, dashpots and hard distances in another order, half of them with their ends swapped.
Scene springs_reordered(Scene scene, unsigned seed);

/// Factors by which the units of length, mass and time change.
struct Scaling {
  double length = 1, mass = 1, time = 1;
};
Scene scaled(Scene scene, const Scaling& scaling);

/// The image of each particle under the reflection through the scene's centre along axis 0, 1 or 2; nullopt if the
/// scene is not symmetric to 1e-9 of its size.
struct Mirror {
  Placement reflection;
  std::vector<int> image;
};
std::optional<Mirror> mirror_of(const Scene& scene);

Scene scene_in(const std::string& folder, const std::string& name);

// The smallest scenes that show relations. Their step of 2^-10 s is exact in every precision. It is at most a fiftieth
// of leapfrog's stable step, so that explicit Euler's growth of 1 + (h omega)^2 / 2 per step stays below a factor of 3
// in a second.

std::vector<Scene> small_nets();      // five particles, one of them pinned, swinging under gravity
std::vector<Scene> falling_nets();    // a tetrahedron released from rest: soft, stiff, with dashpots
std::vector<Scene> resting_nets();    // a tetrahedron at rest, without gravity
std::vector<Scene> flying_nets();     // thrown, rotating and vibrating, without external influences
std::vector<Scene> vibrating_nets();  // two particles on a spring, rotating and vibrating for 16 s
std::vector<Scene> symmetric_nets();  // a strip that hangs from its middle, and one that slides down a slope
std::vector<Scene> nets_anywhere();   // the small net, and the strip on a slope
std::vector<Scene> pinned_nets();     // one net with a fixed pin, one with a moving pin
std::vector<Scene> hanging_chains();  // three masses on three different springs, once with drag and once with dashpots
std::vector<Scene> hanging_chains_in_drag();

}  // namespace crosscheck
