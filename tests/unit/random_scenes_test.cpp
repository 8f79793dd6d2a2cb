// Random scenes: the same by seed, and of all the kinds that they promise.
#include "tests/unit/random_scenes.h"

#include "experiments/metrics.h"
#include "reference/exact/exact.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

TEST(RandomScenes, AreTheSameBySeedAndDifferentBySeed) {
  std::set<std::string> hashes;
  for (unsigned seed = 0; seed < 200; ++seed) {
    EXPECT_EQ(random_exact_scene(seed).hash, random_exact_scene(seed).hash);
    hashes.insert(random_exact_scene(seed).hash);
    hashes.insert(random_contact_free_scene(seed).hash);
  }
  EXPECT_EQ(hashes.size(), 400u);
}

TEST(RandomScenes, HaveEachIngredientOftenButNotAlways) {
  int damped = 0, dashpots = 0, driven = 0, several = 0;
  for (const Scene& s : random_exact_scenes()) {
    EXPECT_TRUE(exact_solution(s)) << s.name;
    damped += s.model.find<Drag>() != nullptr;
    dashpots += s.model.find<Dashpots>() != nullptr;
    driven += s.model.particles.move.has_value();
    several += s.model.particles.size() - s.model.particles.pins.size() > 1;
    EXPECT_FALSE(s.model.find<Spheres>());
  }
  for (const int each : {damped, dashpots, driven, several}) {
    EXPECT_GE(each, 30);
    EXPECT_LE(each, 120);
  }
}

TEST(RandomScenes, NetworksHoldTogetherAndArePredictable) {
  int moved = 0, drag = 0, gusts = 0, damped = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    const Scene s = random_contact_free_scene(seed);
    const Model& m = s.model;
    moved += m.particles.move.has_value();
    drag += m.find<Drag>() != nullptr;
    gusts += m.find<Wind>() && m.find<Wind>()->acceleration.gusts;
    damped += m.find<Dashpots>() != nullptr;
    EXPECT_GE(m.particles.size(), 3);
    EXPECT_LE(m.particles.size(), 30);
    EXPECT_FALSE(m.find<Spheres>());
    // what a window asks of a scene (scene.h); every fourth, for its time
    if (seed % 4 == 1) {
      EXPECT_LT(perturbation_growth(find_method("symplectic-euler"), s, s.step, s.window), 1e3);
    }
  }
  for (const int each : {moved, drag, gusts}) {
    EXPECT_GE(each, 40);
    EXPECT_LE(each, 160);
  }
  EXPECT_EQ(damped, 0);
}

}  // namespace
}  // namespace crosscheck
