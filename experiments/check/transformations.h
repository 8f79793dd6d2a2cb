// Scenes made from other scenes, so that their runs must be made from each other too: turned, shifted, mirrored,
// renumbered, scaled. And the smallest scenes that show relations.
#pragma once

#include <optional>
#include <vector>

#include "mysim/scene/scene.h"

namespace crosscheck {

/// x' = turn x + shift. An orthogonal matrix: a rotation or a reflection.
struct Placement {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  Vec3 shift = Vec3::Zero();  // m

  Points of(const Points& x) const { return ((turn * x).colwise() + shift).eval(); }
};
/// A seeded rotation, all as likely.
Eigen::Matrix3d seeded_turn(unsigned seed);
/// Numbers 0 to n - 1 in a seeded order in which none is where it was.
std::vector<int> seeded_order(int n, unsigned seed);

/// The scene with everything that has a direction or a place.
Scene placed(Scene scene, const Placement& placement);

/// Particle `order[i]` of the scene is the new scene's i.
Scene renumbered(const Scene& scene, const std::vector<int>& order);
/// Springs, bending, dashpots and hard distances in another order, half of them from their other end.
Scene springs_reordered(Scene scene, unsigned seed);

/// Factors of the units in which all is measured.
struct Scaling {
  double length = 1, mass = 1, time = 1;
};
Scene scaled(Scene scene, const Scaling& scaling);

/// Where each particle is mirrored to, by the plane through `centre` across axis 0, 1 or 2; nothing where the scene is
/// not symmetric to 1e-9 of its size.
struct Mirror {
  Placement reflection;
  std::vector<int> image;
};
std::optional<Mirror> mirror_of(const Scene& scene);

/// The scene in experiments/check/FOLDER/NAME.toml.
Scene scene_in(const std::string& folder, const std::string& name);

// The smallest scenes that show relations. Their steps are 2^-10 s, which every precision holds exactly, and a tenth of
// the stable one: explicit Euler's growth of 1 + (h omega)^2 / 2 a step stays below tenfold in a second.

std::vector<Scene> small_nets();      // five particles, one of them pinned, swinging under gravity
std::vector<Scene> falling_nets();    // a tetrahedron at rest: soft, stiff, with dashpots
std::vector<Scene> resting_nets();    // the same without gravity
std::vector<Scene> flying_nets();     // thrown, turning, vibrating, nothing outside acts
std::vector<Scene> vibrating_nets();  // two particles on a spring, turning and vibrating for 16 s
std::vector<Scene> symmetric_nets();  // a strip that hangs from its middle, and one that slides down a slope
std::vector<Scene> nets_anywhere();   // the small net, and the strip on the slope
std::vector<Scene> pinned_nets();     // one with a standing pin, one with a moved one
std::vector<Scene> hanging_chains();  // three masses on springs of three stiffnesses, with drag, with dashpots
std::vector<Scene> hanging_chains_in_drag();

}  // namespace crosscheck
