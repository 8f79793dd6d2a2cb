// The library's single header: the same numbers as mysim's own runs, refusals with reasons, observers that end a run.

#include <gtest/gtest.h>

#include <cmath>

#include "mysim/mysim.h"
#include "tests/unit/helpers.h"

namespace crosscheck::testing_tools {
namespace {

constexpr const char* cloth = R"(
question = "q"
parameters = "p"
[time]
duration = 0.2
samples = 10
step = 1e-3
window = 0.2
tolerance = 1e-3
method = "leapfrog"
[grid]
size = [6, 6]
origin = [0, 0, 0]
u = [1, 0, 0]
v = [0, 0, 1]
mass = 0.1
[grid.stiffness]
structural = 50
shear = 20
[pins]
particles = [0, 5]
[gravity]
acceleration = [0, -9.81, 0]
)";

TEST(Library, RunsAsTheEngineItself) {
  const Scene scene = parse_scene(cloth, "cloth");
  Recorder own;
  const Stepper* leapfrog = nullptr;
  for (const Stepper& one : steppers())
    if (one.name == "leapfrog") leapfrog = &one;
  ASSERT_NE(leapfrog, nullptr);
  simulate(*leapfrog, ContactRule::coulomb, scene, default_run(scene), own);

  const mysim::Scene same = mysim::Scene::parse(cloth, "cloth");
  EXPECT_EQ(same.particles(), 36);
  EXPECT_EQ(same.triangles().size(), 50u);
  std::size_t frames = 0;
  const mysim::Result result = mysim::run(same, {}, [&](const mysim::Frame& frame) {
    const Points& x = own.trajectory.x.at(frames++);
    EXPECT_EQ(frame.x.size(), static_cast<std::size_t>(x.size()));
    EXPECT_TRUE(std::equal(frame.x.begin(), frame.x.end(), x.data())) << frame.t;
    return true;
  });
  EXPECT_TRUE(result.ok()) << result.reason;
  EXPECT_EQ(frames, own.trajectory.x.size());
  EXPECT_EQ(result.steps, 200);
}

mysim::Network oscillator() {
  mysim::Network network;
  network.particles = {{{0, 0, 0}, 1, {}, true}, {{1.1, 0, 0}, 0.5}};
  network.springs = {{0, 1, 200, 1}};
  return network;
}

TEST(Library, ANetworkSwingsAsItsClosedForm) {
  // omega = sqrt(k / m) = 20 rad/s. The frequency of leapfrog is too high by a relative (omega h)^2 / 24. In 1 s this
  // is a phase error of omega^3 h^2 / 24. Times the amplitude, 0.1 m, this is the largest error of the position.
  const mysim::Scene scene = mysim::Scene::of(oscillator(), 1);
  EXPECT_LE(scene.step(), 2 * M_PI / 20 / 20 * (1 + eps));
  double worst = 0, first = -1, drift = 0;
  mysim::run(scene, {}, [&](const mysim::Frame& frame) {
    worst = std::max(worst, std::abs(frame.x[3] - (1 + 0.1 * std::cos(20 * frame.t))));
    const double energy = mysim::energy(scene, frame).total();
    if (first < 0) first = energy;
    drift = std::max(drift, std::abs(energy - first));
    return true;
  });
  EXPECT_LT(worst, 0.1 * 20 * 20 * 20 * scene.step() * scene.step() / 24 * 1.1);
  EXPECT_GT(worst, 0.1 * 20 * 20 * 20 * scene.step() * scene.step() / 24 / 4);
  EXPECT_NEAR(first, 1, 1e-12);  // J, k a^2 / 2
  // leapfrog conserves a quantity that differs from the energy by a relative (omega h)^2 / 4
  EXPECT_LT(drift, 400 * scene.step() * scene.step() / 4 * 1.1);
}

TEST(Library, AnObserverEndsARunAndSeesEveryStepWhereItAsks) {
  const mysim::Scene scene = mysim::Scene::of(oscillator(), 1);
  int seen = 0;
  const mysim::Result result =
      mysim::run(scene, {.step = 1e-3, .every_step = true}, [&](const mysim::Frame&) { return ++seen <= 20; });
  EXPECT_EQ(result.verdict, "stopped");
  EXPECT_EQ(seen, 21);
  EXPECT_NEAR(result.end, 0.02, 1e-12);
}

TEST(Library, ADivergingRunIsAResult) {
  const mysim::Result result =
      mysim::run(mysim::Scene::of(oscillator(), 20), {.stepper = "explicit-euler", .step = 0.05});
  EXPECT_FALSE(result.ok());
  EXPECT_FALSE(result.reason.empty());
}

std::string refusal(const std::function<void()>& work) {
  try {
    work();
  } catch (const mysim::Error& error) {
    return error.what();
  }
  return "nothing was refused";
}

TEST(Library, BadInputIsNamed) {
  const mysim::Scene scene = mysim::Scene::of(oscillator(), 1);
  const auto expect = [](const std::function<void()>& work, const char* words) {
    EXPECT_NE(refusal(work).find(words), std::string::npos) << refusal(work);
  };
  expect([&] { mysim::run(scene, {.stepper = "leap-frog"}); }, "did you mean 'leapfrog'?");
  expect([&] { mysim::run(scene, {.step = -1}); }, "step: expected a number of seconds above zero");
  expect([&] { mysim::run(scene, {.samples = -1}); }, "samples: expected one or more, got -1");
  expect([&] { mysim::run(scene, {.tolerance = 0}); }, "tolerance: expected a number above zero");
  expect([] { mysim::Scene::read("missing.toml"); }, "missing.toml");
  expect(
      [] {
        mysim::Network broken = oscillator();
        broken.springs[0].b = 7;
        mysim::Scene::of(broken, 1);
      },
      "a particle from 0 to 1");
  expect(
      [] {
        mysim::Network broken = oscillator();
        broken.particles[1].mass = NAN;
        mysim::Scene::of(broken, 1);
      },
      "mass: expected a number above zero");
}

}  // namespace
}  // namespace crosscheck::testing_tools
