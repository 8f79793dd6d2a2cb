// Truth of hard distances: Lagrange multipliers keep the distances, the period and the energy; dependent ones are
// refused.
#include <numbers>

#include "experiments/scenes.h"
#include "mysim/errors.h"
#include "reference/exact/exact.h"
#include "reference/multipliers.h"
#include "tests/unit/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

Trajectory by_multipliers(const Scene& scene, const Run& run) {
  MultiplierWorld world(scene, plan(run).h);
  Recorder recorder;
  march(world, run, recorder);
  return recorder.trajectory;
}

Scene without_drag(Scene scene) {
  std::erase_if(scene.model.terms, [](const Term& t) { return std::holds_alternative<Drag>(t); });
  return scene;
}

TEST(Multipliers, KeepDistancesToTheFourthOrder) {
  const Scene scene = load_scene("rod");
  auto drift = [&](double h) {
    double worst = 0;
    for (const Points& x : by_multipliers(scene, {h, 1, 20}).x)
      worst = std::max(worst, largest_stretch(*scene.model.find<Constraints>(), x));
    return worst;
  };
  const double coarse = drift(4e-3), fine = drift(2e-3);
  EXPECT_GT(fine, 1e-13);
  EXPECT_NEAR(slope(coarse, fine), 4, 0.5);  // the drift adds up errors of both signs
}

TEST(Multipliers, OneRodIsTheRigidPendulum) {
  const Scene scene = small_scene(
      "[[particle]]\nposition = [0, 0, 0]\nmass = 1\n[[particle]]\nposition = [0.8660254037844386, -0.5, 0]\nmass = 1\n"
      "[[constraint]]\nends = [0, 1]\n[pins]\nparticles = [0]\n" +
      std::string(gravity_text));
  const double period = rigid_pendulum_period(1, 9.81, std::numbers::pi / 3);
  const Trajectory t = by_multipliers(scene, {1e-3, period, 1});
  // back where it was, at rest: rk4's error in the phase is of order 1e-12, its square shows in the place
  EXPECT_LT((t.x.back() - scene.start.x).norm(), 1e-9);
  EXPECT_LT(t.v.back().norm(), 1e-9);
}

TEST(Multipliers, KeepEnergyAndXpbdConvergesToThem) {
  const Scene scene = without_drag(load_scene("rod"));
  const Trajectory t = by_multipliers(scene, {2.5e-4, 1, 20});
  for (int i = 0; i < t.frames(); ++i)
    EXPECT_NEAR(energy_of(scene.model, {t.t[i], t.x[i], t.v[i]}).total(), 0, 1e-7);  // J; 2 J are turned over, h^4
  double before = 0;
  for (const double h : {4e-4, 2e-4, 1e-4}) {
    const double error = sup_rms(trajectory_of(stepper("xpbd"), load_scene("rod"), {h, 1, 20}),
                                 by_multipliers(load_scene("rod"), {2.5e-4, 1, 20}));
    if (before > 0) {
      EXPECT_NEAR(slope(before, error), 1, 0.1);  // the next term is h omega of the whip, some per cent
    }
    before = error;
  }
}

TEST(Multipliers, DependentDistancesAreRefused) {
  // a straight row between two pins: its forces are not unique
  const Scene scene = small_scene(
      "[[particle]]\nposition = [0, 0, 0]\nmass = 1\n[[particle]]\nposition = [1, 0, 0]\nmass = 1\n"
      "[[particle]]\nposition = [2, 0, 0]\nmass = 1\n[[constraint]]\nends = [0, 1]\n[[constraint]]\nends = [1, 2]\n"
      "[pins]\nparticles = [0, 2]\n" +
      std::string(gravity_text));
  try {
    by_multipliers(scene, {1e-3, 0.1, 1});
    ADD_FAILURE();
  } catch (const Unsupported& e) {
    EXPECT_TRUE(contains(e.what(), "depend on each other"));
  }
  EXPECT_FALSE(truth_of(scene, {1e-3, 0.1, 1}));
}

TEST(Multipliers, AreTheTruthOfScenesWithHardDistances) {
  for (const auto name : {"rod", "cloth-inextensible"}) {
    const Scene scene = load_scene(name);
    const auto truth = truth_of(scene, {scene.step, 0.2, 4});
    ASSERT_TRUE(truth) << name;
    EXPECT_EQ(truth->tier, Tier::converged);
    EXPECT_TRUE(contains(truth->how, "Lagrange multipliers"));
    EXPECT_LT(truth->bar, 1e-6);
  }
}

}  // namespace
}  // namespace crosscheck
