// A scene is its list of ingredients: taking any one away changes the motion by more than the scene's tolerance.
#include "experiments/metrics.h"
#include "experiments/scenes.h"
#include "mysim/observers/watch.h"
#include "tests/unit/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

struct Removal {
  std::string what;
  Scene scene;
};

/// The scene without each of its ingredients in turn.
std::vector<Removal> removals(const Scene& whole) {
  std::vector<Removal> list;
  for (size_t i = 0; i < whole.model.terms.size(); ++i) {
    Scene less = whole;
    less.model.terms.erase(less.model.terms.begin() + static_cast<long>(i));
    list.push_back({std::string(name_of(whole.model.terms[i])), std::move(less)});
  }
  if (whole.model.find<Springs>())
    for (const Family family : {Family::single, Family::structural, Family::shear, Family::bend}) {
      Scene less = whole;
      if (std::erase_if(less.model.find<Springs>()->list, [&](const Spring& s) { return s.family == family; }) > 0)
        list.push_back({fmt::format("{} springs", name_of(family)), std::move(less)});
    }
  if (!whole.model.particles.pins.empty()) {
    Scene less = whole;
    less.model.particles.pins.clear();
    less.model.particles.pinned.assign(less.model.particles.pinned.size(), 0);
    less.model.particles.move.reset();
    list.push_back({"pins", std::move(less)});
  }
  if (whole.model.particles.move) {
    Scene less = whole;
    less.model.particles.move.reset();
    list.push_back({"pins' motion", std::move(less)});
  }
  if (const auto* wind = whole.model.find<Wind>(); wind && wind->acceleration.gusts) {
    Scene less = whole;
    less.model.find<Wind>()->acceleration.gusts.reset();
    list.push_back({"gusts", std::move(less)});
  }
  if (const auto* air = whole.model.find<Aerodynamics>(); air && air->velocity.gusts) {
    Scene less = whole;
    less.model.find<Aerodynamics>()->velocity.gusts.reset();
    list.push_back({"gusts", std::move(less)});
  }
  if (const auto* spheres = whole.model.find<Spheres>(); spheres && spheres->moving()) {
    Scene less = whole;
    for (Sphere& sphere : less.model.find<Spheres>()->list) sphere.motion.reset();
    list.push_back({"spheres' motion", std::move(less)});
  }
  if (const auto* spheres = whole.model.find<Spheres>(); spheres && spheres->list[0].friction > 0) {
    Scene less = whole;
    for (Sphere& sphere : less.model.find<Spheres>()->list) sphere.friction = 0;
    list.push_back({"friction", std::move(less)});
  }
  return list;
}

TEST(Scenes, EveryIngredientMattersWithinTheWindow) {
  for (const auto name : shipped_scenes()) {
    const Scene scene = load_scene(std::string(name));
    const Stepper& s = stepper(scene.method);  // shipped scenes name one of mysim's own
    const int samples = std::max(1, static_cast<int>(scene.samples * scene.window / scene.duration));
    const crosscheck::Run run{scene.step, scene.window, samples};
    const Trajectory whole = trajectory_of(s, scene, run);
    for (const Removal& removal : removals(scene)) {
      SCOPED_TRACE(fmt::format("{} without {}", name, removal.what));
      // nothing is left to move a first-order scene: it cannot run, which is change enough
      if (scene.model.first_order() && !removal.scene.model.first_order()) continue;
      const double change = sup_rms(whole, trajectory_of(s, removal.scene, run));
      fmt::print("{:12} without {:18} {:.3g} m (tolerance {:.3g} m)\n", name, removal.what, change, scene.tolerance);
      EXPECT_GT(change, scene.tolerance);
    }
  }
}

}  // namespace
}  // namespace crosscheck
