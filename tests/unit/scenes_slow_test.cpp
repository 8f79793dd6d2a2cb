// A scene is its list of ingredients: taking any one away changes the motion by more than the scene's tolerance.
#include "experiments/adequacy/ingredients.h"
#include "experiments/metrics.h"
#include "experiments/scenes.h"
#include "mysim/observers/watch.h"
#include "tests/unit/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

TEST(Scenes, EveryIngredientMattersWithinTheWindow) {
  for (const auto name : shipped_scenes()) {
    const Scene scene = load_scene(std::string(name));
    const Stepper& s = stepper(scene.method);  // shipped scenes name one of mysim's own
    const int samples = std::max(1, static_cast<int>(scene.samples * scene.window / scene.duration));
    const crosscheck::Run run{scene.step, scene.window, samples};
    const Trajectory whole = trajectory_of(s, scene, run);
    for (const Ingredient& ingredient : ingredients_of(scene)) {
      SCOPED_TRACE(fmt::format("{} without {}", name, ingredient.name));
      const Scene less = without(scene, ingredient);
      // nothing is left to move a first-order scene: it cannot run, which is change enough
      if (scene.model.first_order() && !less.model.first_order()) continue;
      const double change = sup_rms(whole, trajectory_of(s, less, run));
      fmt::print("{:12} without {:18} {:.3g} m (tolerance {:.3g} m)\n", name, ingredient.name, change, scene.tolerance);
      EXPECT_GT(change, scene.tolerance);
    }
  }
}

}  // namespace
}  // namespace crosscheck
