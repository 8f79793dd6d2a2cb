// Error bars of the converged truth cover the error, and are as small as required.

#include "tests/unit/reference/helpers.h"
#include "tests/unit/reference/truth_trials.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

TEST(Truth, BarsCoverTheErrorAndAreNotMuchTooWide) {
  // seeds 0 to 199; truth_trials.cpp accepts any
  std::vector<BarTrial> trials;
  for (const Scene& scene : random_exact_scenes()) trials.push_back(bar_trial(scene));
  const BarSummary s = summary_of(trials);
  fmt::print("{}\n", text_of(s));
  EXPECT_EQ(s.scenes, 200u);
  EXPECT_GE(s.covered, 198u);
  // A bar of three times the estimate of a fourth-order rule is three times the error, provided that this order is
  // observed. Errors below ten times round-off show no order.
  EXPECT_GE(s.above, 100u);
  EXPECT_LE(s.median, 5);
  EXPECT_LE(s.high, 20);
  for (const BarTrial& t : trials) {
    EXPECT_GE(t.ratio(), 0.9) << t.scene;
  }
}

TEST(Truth, BarsGrowWithTimeUpToTheLargest) {
  for (const char* name : {"pendulum", "cloth-student"}) {
    const Scene scene = shipped_scene(name);
    const auto truth = converged_truth(scene, {scene.step, std::min(0.5, scene.window), 20});
    ASSERT_TRUE(truth);
    ASSERT_EQ(truth->error_bars.size(), truth->trajectory.t.size());
    EXPECT_TRUE(std::is_sorted(truth->error_bars.begin(), truth->error_bars.end()));
    EXPECT_EQ(truth->error_bars.back(), truth->error_bar);
  }
}

TEST(Truth, BarsAreAsSmallAsAskedForInTheWindows) {
  // m; chains with a closed form also have a converged solution
  const std::pair<const char*, double> error_bars[] = {
      {"spring", 1e-9},       {"pendulum", 1e-9},      {"chain", 1e-9},      {"chain-link", 1e-9},
      {"normal-modes", 1e-9}, {"cloth-student", 1e-6}, {"cloth-hang", 1e-6}, {"cloth-swing", 1e-6},
      {"cloth-wind", 1e-6},   {"flag", 1e-6},          {"rod", 1e-6},        {"cloth-inextensible", 1e-6}};
  for (const auto& [name, largest] : error_bars) {
    SCOPED_TRACE(name);
    const Scene scene = shipped_scene(name);
    // To save time, tests only the first half second of the cloths' windows; the bars over the whole windows were 2e-9
    // to 7e-9 m.
    const double until = scene.triangles.empty() ? scene.window : std::min(0.5, scene.window);
    const auto truth = converged_truth(scene, {scene.step, until, 20});
    ASSERT_TRUE(truth);
    fmt::print("{:20} bar {:.2g} m: {}\n", name, truth->error_bar, truth->how);
    EXPECT_LT(truth->error_bar, largest);
    EXPECT_EQ(truth->tier, Tier::converged);
    EXPECT_TRUE(contains(truth->how, "mysim/rk4 at"));
    EXPECT_TRUE(contains(truth->how, "odeint (Boost"));
  }
}

TEST(Truth, IsNoneWhereTheMotionIsChaoticOrStiffnessDefeatsIt) {
  // An undamped double pendulum, long enough for a perturbation to grow without limit.
  const Scene chaos = small_scene(
      "[[particle]]\nposition = [0, 0, 0]\nmass = 1\n[[particle]]\nposition = [0.5, 0.8, 0]\nmass = 1\n"
      "[[particle]]\nposition = [0.5, 1.8, 0.1]\nmass = 1\n[[spring]]\nends = [0, 1]\nstiffness = 1000\n"
      "[[spring]]\nends = [1, 2]\nstiffness = 1000\n[pins]\nparticles = [0]\n" +
          std::string(gravity_text),
      40, 1e-2, 40);
  EXPECT_FALSE(converged_truth(chaos, default_run(chaos)));
  const auto at_first = converged_truth(chaos, {1e-2, 1, 10});
  ASSERT_TRUE(at_first);
  EXPECT_LT(at_first->error_bar, 1e-6);
}

}  // namespace
}  // namespace crosscheck
