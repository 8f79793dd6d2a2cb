#include <initializer_list>

#include "experiments/check/transformations.h"
#include "mysim/base/installation.h"

namespace crosscheck {

Scene scene_in(const std::string& folder, const std::string& name) {
  return read_scene(data_folder() / "experiments/check" / folder / (name + ".toml"));
}

namespace {
std::vector<Scene> scenes_named(std::initializer_list<const char*> names) {
  std::vector<Scene> scenes;
  for (const char* name : names) scenes.push_back(scene_in("scenes", name));
  return scenes;
}
}  // namespace

std::vector<Scene> small_nets() { return scenes_named({"small-net"}); }
std::vector<Scene> falling_nets() { return scenes_named({"falling-soft", "falling-stiff", "falling-damped"}); }
std::vector<Scene> resting_nets() { return scenes_named({"resting-net"}); }
std::vector<Scene> flying_nets() { return scenes_named({"flying-net"}); }
std::vector<Scene> vibrating_nets() { return scenes_named({"dumbbell"}); }
std::vector<Scene> symmetric_nets() { return scenes_named({"hanging-strip", "sliding-strip"}); }
std::vector<Scene> nets_anywhere() { return scenes_named({"small-net", "sliding-strip"}); }
std::vector<Scene> pinned_nets() {
  Scene standing = scene_in("scenes", "small-net"), moved = standing;
  standing.name = "standing-pin", moved.name = "moved-pin";
  moved.model.particles.move = Motion{{0.05, 0.02, -0.03}, 2, 0.25};
  moved.hash = hash_of(moved);
  return {standing, moved};
}
std::vector<Scene> hanging_chains() { return scenes_named({"chain-in-drag", "chain-with-dashpots"}); }
std::vector<Scene> hanging_chains_in_drag() { return scenes_named({"chain-in-drag"}); }

}  // namespace crosscheck
