// A run that is observed and changed by hand equals the engine's run bit for bit. A scene starts in the state given in
// its section [start].

#include <gtest/gtest.h>

#include "experiments/scenes/scenes.h"
#include "mysim/base/errors.h"
#include "mysim/base/json.h"
#include "report/base/assets.h"
#include "report/lab/live_run.h"
#include "tests/unit/helpers.h"
#include "tests/unit/reference/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

LiveRun::Settings settings_of(const Scene& scene, const std::string& rule) {
  return {.rule = rule, .step = scene.step, .tolerance = 1e-6, .duration = scene.duration, .keep_ledger = true};
}

TEST(LiveRun, IsTheRunOfTheEngine) {
  for (const char* name : {"chain", "bounce", "slide", "circle"})
    for (const Stepper& stepper : steppers()) {
      const Scene scene = load_scene(name);
      LiveRun live(scene);
      try {
        live.start(settings_of(scene, std::string(stepper.name)));
      } catch (const Unsupported&) {
        continue;
      }
      for (double t = 0; live.advance(t, 1000000); t += scene.duration / 7) {
      }
      crosscheck::Run run = default_run(scene);
      run.tolerance = 1e-6;
      const MethodRun whole = run_and_record(fmt::format("mysim/{}", stepper.name), scene, run);
      SCOPED_TRACE(fmt::format("{} {}", name, stepper.name));
      EXPECT_EQ(live.outcome().verdict, whole.outcome.verdict);
      EXPECT_EQ(live.time(), whole.outcome.end);
      EXPECT_EQ(live.outcome().steps, whole.outcome.steps);
      EXPECT_EQ(live.outcome().evaluations, whole.outcome.evaluations);
      if (whole.outcome.verdict == Verdict::ok) {
        EXPECT_EQ(live.state().x, whole.trajectory.x.back());
      }
    }
}

TEST(LiveRun, PredictsTheCriticalStepAndFailsAboveItAlone) {
  const Scene spring = load_scene("spring");
  int tried = 0;
  for (const Stepper& stepper : steppers()) {
    const std::optional<double> limit = LiveRun(spring).critical_step(stepper);
    if (!limit || !(*limit > 0) || !std::isfinite(*limit)) continue;
    // omit rk4, which stays bounded above its limit: it throws the mass over its pin, where the spring's force reverses
    if (!stepper.symplectic) continue;
    ++tried;
    for (const double part : {0.98, 1.02}) {
      // choose the duration so that there are ten steps between samples, and no step is shortened
      Scene scene = spring;
      scene.samples = 400, scene.duration = 10 * 400 * part * *limit;
      LiveRun live(scene);
      LiveRun::Settings settings = settings_of(scene, std::string(stepper.name));
      settings.step = part * *limit * (1 + 1e-9);
      live.start(settings);
      live.advance(scene.duration, 1000000);
      EXPECT_EQ(live.outcome().verdict == Verdict::ok, part < 1) << stepper.name << " at " << part << " of its limit";
    }
  }
  EXPECT_GE(tried, 3);
}

TEST(LiveRun, AHandHoldsAParticleWhereItIsPut) {
  const Scene scene = load_scene("chain");
  const int last = scene.model.particles.size() - 1;
  LiveRun live(scene);
  live.start(settings_of(scene, "leapfrog"));
  live.advance(0.2, 1000000);
  const Vec3 place = live.state().x.col(last) + Vec3(0.01, 0.02, 0);
  live.hold(last, place);
  EXPECT_EQ(live.time(), 0);
  live.advance(0.1, 1000000);
  EXPECT_EQ(live.state().x.col(last), place);
  live.release();
  live.advance(0.1, 1000000);
  EXPECT_NE(live.state().x.col(last), place);
  // a particle that is pinned stays at its position until it is released
  live.set_pinned(last, true);
  const Vec3 pinned = live.state().x.col(last);
  live.advance(0.1, 1000000);
  EXPECT_EQ(live.state().x.col(last), pinned);
  live.set_pinned(last, false);
  live.advance(0.1, 1000000);
  EXPECT_NE(live.state().x.col(last), pinned);
  // a particle that was pinned before it was held is pinned again after its release
  const int pin = scene.model.particles.pins.front();
  live.hold(pin, Vec3(0.05, 0, 0));
  live.release();
  EXPECT_EQ(live.scene().model.particles.pinned[static_cast<size_t>(pin)], 1);
}

TEST(LiveRun, RefusesWhatTheEngineRefuses) {
  const Scene circle = load_scene("circle");
  LiveRun live(circle);
  EXPECT_THROW(live.start(settings_of(circle, "leapfrog")), Unsupported);
  EXPECT_NE(refusal_of([&] { live.start(settings_of(circle, "leapfog")); }).find("did you mean 'leapfrog'"),
            std::string::npos);
  EXPECT_NE(refusal_of([&] { live.start(settings_of(circle, "rk4+linear")); }).find("unknown option '+linear'"),
            std::string::npos);
}

TEST(Words, HaveTheQuestionOfEveryShippedScene) {
  const JsonField words = JsonField::parse(asset("page/lab/words/en.json"), "en.json");
  for (const std::string_view name : shipped_scenes()) {
    const Scene scene = load_scene(std::string(name));
    EXPECT_EQ(words[fmt::format("question.{}", name)].text(), scene.question)
        << "the lab translates a question only if its table of words contains the scene's exact text";
  }
}

const std::string two_particles = scene_text(R"([[particle]]
position = [0, 0, 0]
mass = 1
[[particle]]
position = [1, 0, 0]
mass = 1
[[spring]]
ends = [0, 1]
stiffness = 100
[pins]
particles = [0]
)");

TEST(Start, IsWhereTheSceneStartsAndSpringsKeepTheirLengths) {
  const Scene moved = parse_scene(
      two_particles + "[start]\npositions = [0, 0.5, 0, 1.5, 0.5, 0]\nvelocities = [0, 0, 0, 0, 2, 0]\n", "moved");
  EXPECT_EQ(moved.start.x.col(0), Vec3(0, 0.5, 0));
  EXPECT_EQ(moved.start.x.col(1), Vec3(1.5, 0.5, 0));
  EXPECT_EQ(moved.start.v.col(1), Vec3(0, 2, 0));
  EXPECT_EQ(moved.model.particles.pin_home.col(0), Vec3(0, 0.5, 0));
  EXPECT_EQ(moved.model.find<Springs>()->list[0].rest, 1);
  EXPECT_NE(moved.hash, parse_scene(two_particles, "moved").hash);
}

TEST(Start, SaysWhatIsWrongWithIt) {
  const auto message = [&](const std::string& start, const std::string& words) {
    const std::string said = refusal_of([&] { parse_scene(two_particles + start, "start.toml", "start"); });
    EXPECT_NE(said.find(words), std::string::npos) << said;
  };
  message("[start]\npositions = [0, 0, 0]\n", "start.positions: expected a list of 6 finite numbers, got 3");
  message("[start]\npositions = [0, 0, 0, 1, 0, nan]\n", "start.positions[5]: expected a finite number");
  message("[start]\npositions = 3\n", "start.positions: expected a list of 6 finite numbers, got 3");
  message("[start]\nvelocities = [0, 0, 0, 0, 0, 0]\n",
          "start.positions: is missing; expected a list of three numbers for each particle");
  message("[start]\npositions = [0, 0, 0, 1, 0, 0]\nvelocities = [0, 1, 0, 0, 0, 0]\n", "pins that start at rest");
}

}  // namespace
}  // namespace crosscheck
