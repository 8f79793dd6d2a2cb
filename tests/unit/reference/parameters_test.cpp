// Scene parameters in other engines: round trips within the stated error, comparison with known values, and messages
// for invalid files.

#include "reference/parameters/parameters.h"

#include "reference/bullet/parameters.h"
#include "tests/unit/helpers.h"
#include "tests/unit/reference/helpers.h"

namespace crosscheck {
namespace {

using namespace testing_tools;

constexpr const char* targets[] = {"mysim/leapfrog",
                                   "mysim/xpbd",
                                   "bullet/pbd",
                                   "bullet/pbd+n=10",
                                   "bullet32/pbd+n=4",
                                   "bullet/deformable-explicit",
                                   "bullet/deformable-implicit",
                                   "jolt",
                                   "rapier",
                                   "box3d+n=1",
                                   "mujoco",
                                   "godot"};

// every kind of scene: single springs, a chain with another law, cloths, a block with dashpots on a ball, hard
// distances
constexpr const char* twelve[] = {"spring",      "normal-modes", "pendulum",   "chain", "chain-link",    "cloth-hang",
                                  "cloth-stiff", "cloth-swing",  "cloth-wind", "jelly", "cloth-carried", "flag"};

/// Compares all numbers of two scenes.
void expect_within(const Scene& back, const Scene& scene, const Translation& t) {
  for (const TranslatedNumber& number : t.numbers) {
    const auto was = values_of(scene, number.rule->quantity), is = values_of(back, number.rule->quantity);
    ASSERT_EQ(is.size(), was.size()) << name_of(number.rule->quantity);
    for (size_t i = 0; i < was.size(); ++i)
      EXPECT_LE(std::abs(is[i] - was[i]), number.stated * std::abs(was[i]))
          << name_of(number.rule->quantity) << " " << i << ", stated " << number.stated;
  }
}

/// Largest k h^2 / mu of the springs at the scene's own step.
double largest_K(const Scene& scene) {
  double most = 0;
  for (const Spring& s : scene.model.find<Springs>()->list)
    most = std::max(most, s.k * scene.step * scene.step / bullet::pair_mass(scene.model.particles, s));
  return most;
}

TEST(Translation, OfTwelveScenesThereAndBackIsWithinTheStatedError) {
  for (const char* name : twelve) {
    const Scene scene = shipped_scene(name);
    for (const char* to : targets) {
      SCOPED_TRACE(fmt::format("{} to {}", name, to));
      const TranslationTarget target = find_target(to, 0);
      const Translation t = translate(scene, target, scene.step);
      EXPECT_GE(t.numbers.size(), 2u);
      expect_within(t.back, scene, t);
      // and through a file
      const NumbersFile file = read_numbers(numbers_toml(scene, t), "numbers.toml", scene, target, 0);
      EXPECT_EQ(file.h, t.h);
      EXPECT_EQ(file.iterations, target.iterations);
      expect_within(scene_of(scene, *target.numbers, file), scene, t);
      for (const TranslatedNumber& number : t.numbers) {
        if (number.rule->gather == NumberRule::Gather::median) continue;  // one slider for all springs: not one-to-one
        // One-to-one conversions err by the precision's round-off times a factor: 2 + k h^2 / mu for links; 3 for
        // frequencies, which are squared and combined with rounded masses.
        const double rounding = 0.5 * (target.single_precision ? 1.2e-7 : eps) + 8 * eps;
        EXPECT_LE(number.stated, (1 + 1e-9) * rounding * (3 + largest_K(scene))) << name_of(number.rule->quantity);
      }
    }
  }
}

TEST(Translation, StatedErrorIsReached) {
  // The test above would pass with any sufficiently large bound. Single precision must use up at least a hundredth of
  // it.
  const Scene scene = shipped_scene("cloth-hang");
  for (const char* to : {"bullet32/pbd+n=4", "jolt"}) {
    const Translation t = translate(scene, find_target(to, 0), scene.step);
    for (const TranslatedNumber& number : t.numbers) {
      if (number.rule->quantity != SceneNumber::stiffness) continue;
      double most = 0;
      for (size_t i = 0; i < number.scene.size(); ++i)
        most = std::max(most, std::abs(number.back[i] / number.scene[i] - 1));
      EXPECT_GT(most, 0.01 * number.stated) << to;
    }
  }
}

/// Two particles of 1 kg on a spring; mu is 1 kg if the first one is pinned.
Scene one_spring(double k, bool pinned, const std::string& more = "") {
  return small_scene(
      fmt::format("[[particle]]\nposition = [0, 0, 0]\nmass = 1\n[[particle]]\nposition = [0, -1, 0]\n"
                  "mass = 1\n[[spring]]\nends = [0, 1]\nstiffness = {}\ndashpot = 0.5\n{}{}",
                  k, pinned ? "[pins]\nparticles = [0]\n" : "", more));
}

double engine_number(const Translation& t, SceneNumber quantity) {
  for (const TranslatedNumber& number : t.numbers)
    if (number.rule->quantity == quantity) return number.engine[0];
  ADD_FAILURE() << "no " << name_of(quantity);
  return NAN;
}

TEST(Translation, OfALinkHasTheMeasuredValues) {
  // Values measured once from the sag of a mass on one link of Bullet, for mu = 1 kg; N/m and kLST have five digits.
  struct Case {
    double kLST, h;
    int n;
    double k;
  };
  for (const Case& c : {Case{0.1, 1. / 60, 1, 400.0},
                        {0.1, 1. / 60, 4, 1887.0},
                        {0.1, 1. / 60, 10, 6724.7},
                        {0.5, 1. / 60, 1, 3600},
                        {0.5, 1. / 240, 4, 8.64e5},
                        {0.5, 1. / 1000, 1, 1e6}}) {
    const Scene scene = one_spring(c.k, true);
    const Translation t = translate(scene, find_target(fmt::format("bullet/pbd+n={}", c.n), 0), c.h);
    EXPECT_NEAR(engine_number(t, SceneNumber::stiffness), c.kLST, 3e-5 * c.kLST) << c.k;
    const Translation sliders = translate(scene, find_target("godot", c.n), c.h);
    EXPECT_NEAR(engine_number(sliders, SceneNumber::stiffness), c.kLST, 3e-5 * c.kLST);
    EXPECT_EQ(engine_number(sliders, SceneNumber::mass), 2) << "all particles, including the pin";
    // Two free ends have half the reduced mass, so half the stiffness gives the same kLST.
    const Translation free = translate(one_spring(c.k / 2, false), t.target, c.h);
    EXPECT_NEAR(engine_number(free, SceneNumber::stiffness), c.kLST, 3e-5 * c.kLST);
  }
}

TEST(Translation, ToSoftConstraintsIsFrequencyAndDampingRatioAtTheReducedMass) {
  const double k = 250, h = 0.01, gamma = 2;
  for (const bool held : {true, false}) {
    const Scene scene = one_spring(k, held, "[drag]\ngamma = 2\n");
    double inverse = 0;  // pins have infinite mass
    for (int i = 0; i < scene.model.particles.size(); ++i)
      if (!scene.model.particles.pinned[i]) inverse += 1 / scene.model.particles.mass[i];
    for (const char* to : {"rapier", "box3d"}) {
      const Translation t = translate(scene, find_target(to, 0), h);
      EXPECT_NEAR(engine_number(t, SceneNumber::stiffness), std::sqrt(k * inverse) / (2 * M_PI), 1e-6) << to;
      // four sub-steps that each divide the velocity must leave a factor of exp(-gamma h)
      const double damping = engine_number(t, SceneNumber::drag);
      EXPECT_NEAR(std::pow(1 + damping * h / 4, -4), std::exp(-gamma * h), 1e-7) << to;
    }
  }
}

TEST(Translation, OfOtherNumbersIsTheFormulas) {
  const Scene scene = one_spring(250, true, "[drag]\ngamma = 2\n[gravity]\nacceleration = [0, -10, 0]\n");
  const double h = 0.01;
  const auto in = [&](const char* to) { return translate(scene, find_target(to, 0), h); };
  EXPECT_DOUBLE_EQ(engine_number(in("bullet/pbd"), SceneNumber::drag), -std::expm1(-0.02));
  EXPECT_DOUBLE_EQ(engine_number(in("bullet/deformable-explicit"), SceneNumber::drag), 0.02);
  EXPECT_DOUBLE_EQ(engine_number(in("bullet/deformable-explicit"), SceneNumber::stiffness), 250 / 0.98);
  EXPECT_DOUBLE_EQ(engine_number(in("bullet/deformable-explicit"), SceneNumber::gravity), 10 / 0.98);
  EXPECT_DOUBLE_EQ(engine_number(in("bullet/deformable-implicit"), SceneNumber::stiffness), 250);
  EXPECT_DOUBLE_EQ(engine_number(in("mysim/xpbd"), SceneNumber::stiffness), 0.004);
  EXPECT_DOUBLE_EQ(engine_number(in("mysim/xpbd"), SceneNumber::dashpot), 0.5);
  // Jolt takes ten sub-steps of 1 ms. Each multiplies velocities by 1 minus 1 ms times the damping; all ten together
  // must multiply them by exp(-0.02).
  const Translation jolt = in("jolt+n=10");
  EXPECT_NEAR(std::pow(1 - 1e-3 * engine_number(jolt, SceneNumber::drag), 10), std::exp(-0.02), 1e-7);
  EXPECT_FLOAT_EQ(engine_number(jolt, SceneNumber::stiffness), 0.004);
  ASSERT_EQ(jolt.lost.size(), 1u);
  EXPECT_NE(jolt.lost[0].find("dashpot"), std::string::npos);
  EXPECT_EQ(jolt.back.model.find<Dashpots>(), nullptr);
}

TEST(Translation, IsWhatTheWorldsHold) {
  // stiffness (N/m) that Bullet's position-based world reports after a step, by its own formula
  const Scene scene = shipped_scene("cloth-hang");
  const Translation t = translate(scene, find_target("bullet/pbd+n=4", 0), scene.step);
  const Outcome out = run_and_record("bullet/pbd+n=4", t.back, {scene.step, scene.step, 1}).outcome;
  ASSERT_TRUE(out.readback);
  const auto k = values_of(scene, SceneNumber::stiffness);
  for (size_t i = 0; i < k.size(); ++i) EXPECT_NEAR(*out.readback->links[i].stiffness, k[i], 1e-10 * k[i]);
  EXPECT_NEAR((*out.readback->drag)[0], values_of(scene, SceneNumber::drag)[0], 1e-12);
}

TEST(Translation, OneSliderForManySpringsSaysWhatItCosts) {
  // Links to a pin have twice the reduced mass, so the same kLST means twice the stiffness.
  const Scene scene = shipped_scene("chain");
  const Translation t = translate(scene, find_target("godot", 0), scene.step);
  for (const TranslatedNumber& number : t.numbers)
    if (number.rule->quantity == SceneNumber::stiffness) {
      EXPECT_EQ(number.engine.size(), 1u);
      EXPECT_NEAR(number.stated, 1, 1e-5);
      EXPECT_NEAR(number.back[0], 2 * number.scene[0], 1e-4 * number.scene[0]);
      EXPECT_NEAR(number.back[1], number.scene[1], 1e-5 * number.scene[1]);
    }
}

std::string refusal(const Scene& scene, const std::string& to, double h) {
  try {
    translate(scene, find_target(to, 0), h);
  } catch (const Unsupported& why) {
    return why.what();
  }
  return "";
}

TEST(Translation, SaysWhatHasNoNumber) {
  const Scene uneven = small_scene(
      "[[particle]]\nposition = [0, 0, 0]\nmass = 1\n[[particle]]\nposition = [0, -1, 0]\nmass = 3\n[[spring]]\n"
      "ends = [0, 1]\nstiffness = 10\n[drag]\ncoefficient = 1\n");
  for (const char* to : {"bullet/pbd", "bullet/deformable-explicit", "jolt", "godot"})
    EXPECT_NE(refusal(uneven, to, 0.01).find("one "), std::string::npos) << to << ": " << refusal(uneven, to, 0.01);
  EXPECT_NE(refusal(uneven, "godot", 0.01).find("damping_coefficient for the whole body"), std::string::npos);
  EXPECT_EQ(refusal(uneven, "mysim/xpbd", 0.01), "");
  EXPECT_NE(refusal(shipped_scene("circle"), "bullet/pbd", 0.01).find("first-order"), std::string::npos);
  // drag that would stop all motion in one step
  EXPECT_NE(refusal(one_spring(1, true, "[drag]\ngamma = 200\n"), "bullet/deformable-explicit", 0.01)
                .find("drag = 2; expected a number from 0 to below 1"),
            std::string::npos);
  // a link that single precision cannot distinguish from a rigid one
  EXPECT_NE(refusal(one_spring(1e12, true), "bullet32/pbd", 0.01).find("in single precision"), std::string::npos);
}

std::string error_of(auto work) {
  try {
    work();
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(Translation, TargetsThatAreNotKnownAreNamed) {
  struct Case {
    const char* name;
    int iterations;
    std::vector<const char*> parts;
  };
  for (const Case& c : {Case{"bulet/pbd", 0, {"unknown method", "did you mean 'bullet/pbd'?"}},
                        {"odeint/rk4", 0, {"odeint/rk4: no known parameters", "jolt, rapier, box3d, mujoco, godot"}},
                        {"bullet/pbd+demo", 0, {"bullet/pbd+demo: no known parameters"}},
                        {"jolt+m=3", 0, {"method jolt: unknown option '+m=3'", "mNumIterations"}},
                        {"bullet/pbd+n=4", 5, {"--iterations 5 contradicts bullet/pbd+n=4"}},
                        {"godot+n=4", 5, {"--iterations 5 contradicts godot+n=4"}},
                        {"mysim/xpbd", 5, {"--iterations: mysim/xpbd always takes one pass", "--step"}}}) {
    const std::string message = error_of([&] { find_target(c.name, c.iterations); });
    for (const char* part : c.parts) EXPECT_NE(message.find(part), std::string::npos) << message;
  }
  EXPECT_EQ(find_target("bullet/pbd", 7).name, "bullet/pbd+n=7");
  EXPECT_EQ(find_target("bullet/pbd", 7).iterations, 7);
  EXPECT_EQ(find_target("bullet/pbd+n=7", 7).iterations, 7);
  EXPECT_EQ(find_target("godot", 0).iterations, 5);
  EXPECT_EQ(find_target("godot", 0).runs->name, "bullet/pbd+n=5");
  EXPECT_FALSE(find_target("jolt", 0).runs);
}

TEST(NumbersFile, SaysFileLineAndKey) {
  const Scene scene = shipped_scene("chain");
  struct Case {
    const char* to;
    const char* text;
    std::vector<const char*> parts;
  };
  for (const Case& c :
       {Case{"bullet/pbd", "kLST = 0.5\n", {"n.toml", "step: expected the engine's time step (s)", "--step"}},
        {"bullet/pbd", "step = 0.01\nkLST = 1.2\n", {"n.toml:2: kLST: expected", "over-relaxes", "got 1.2"}},
        {"bullet/pbd", "step = 0.01\nkLST = 1\n", {"n.toml:2: kLST: expected", "rigid"}},
        {"bullet/pbd", "step = 0.01\nkLST = [0.1, 0.2]\n", {"n.toml:2: kLST: expected a list of 3 finite numbers"}},
        {"bullet/pbd", "step = 0.01\nkLST = [0.1, 0.2, 0]\n", {"n.toml:2: kLST[2]: expected", "got 0"}},
        {"bullet/pbd", "step = 0.01\nkLST = \"half\"\n", {"n.toml:2: kLST: expected a"}},
        {"bullet/pbd", "step = 0.01\nkDP = 1\n", {"n.toml:2: kDP: expected a number from 0 to below 1, got 1"}},
        {"bullet/pbd", "step = 0.01\nk = 100\n", {"n.toml:2", "k"}},
        {"bullet/pbd", "step = 0.01\n", {"n.toml: expected at least one of mass, kDP, kLST", "bullet/pbd"}},
        {"bullet/pbd",
         "method = \"jolt\"\nstep = 0.01\nkLST = 0.5\n",
         {"n.toml:1: method: expected parameters of bullet/pbd, got those of jolt"}},
        {"mysim/xpbd", "step = 0.01\ncompliance = 0\n", {"compliance: expected a number above zero, got 0"}},
        {"mysim/xpbd", "step = 0.01\niterations = 4\ncompliance = 1\n", {"iterations: expected 1 or no such key"}},
        {"mysim/xpbd", "step = 0.01\nc = 1\n", {"c: expected no such key", "the scene has no dashpot"}},
        {"godot",
         "step = 0.01\nlinear_stiffness = [0.1, 0.2, 0.3]\n",
         {"linear_stiffness: expected one number for the whole body"}}}) {
    const std::string message = error_of([&] { read_numbers(c.text, "n.toml", scene, find_target(c.to, 0), 0); });
    for (const char* part : c.parts) EXPECT_NE(message.find(part), std::string::npos) << c.text << message;
  }
}

TEST(NumbersFile, TheCommandsStepAndIterationsCountMore) {
  const Scene scene = shipped_scene("chain");
  const std::string text = "step = 0.01\niterations = 4\nkLST = 0.5\n";
  EXPECT_EQ(read_numbers(text, "n", scene, find_target("bullet/pbd", 0), 0).iterations, 4);
  EXPECT_EQ(read_numbers(text, "n", scene, find_target("bullet/pbd", 9), 0).iterations, 9);
  EXPECT_EQ(read_numbers(text, "n", scene, find_target("bullet/pbd", 0), 0).h, 0.01);
  EXPECT_EQ(read_numbers(text, "n", scene, find_target("bullet/pbd", 0), 0.02).h, 0.02);
}

TEST(SceneFile, HoldsWhatComesBack) {
  for (const char* name : {"chain", "cloth-hang", "jelly", "cloth-carried"}) {
    const Scene scene = shipped_scene(name);
    // round trip without changes: the same scene bit for bit
    const Translation t = translate(scene, find_target("bullet/pbd", 0), scene.step);
    EXPECT_EQ(parse_scene(scene_toml(scene, t.back, 1e-12), "again").hash, scene.hash) << name;
    // every number changed
    Scene other = scene;
    for (Spring& s : other.model.find<Springs>()->list) s.k *= 2;
    other.model.particles.mass *= 3;
    if (auto* drag = other.model.find<Drag>()) drag->c *= 12;
    if (auto* dashpots = other.model.find<Dashpots>())
      for (auto& d : dashpots->list) d.c *= 5;
    if (auto* spheres = other.model.find<Spheres>())
      for (Sphere& s : spheres->list) s.friction = 0.125;
    const Scene read = parse_scene(scene_toml(scene, other, 1e-12), "changed");
    for (const SceneNumber quantity :
         {SceneNumber::mass, SceneNumber::drag, SceneNumber::stiffness, SceneNumber::dashpot, SceneNumber::friction}) {
      const auto is = values_of(read, quantity), wanted = values_of(other, quantity);
      ASSERT_EQ(is.size(), wanted.size());
      for (size_t i = 0; i < is.size(); ++i) EXPECT_NEAR(is[i], wanted[i], 1e-12 * wanted[i]) << name_of(quantity);
    }
  }
}

TEST(SceneFile, RefusesWhatAFamilyCannotHold) {
  const Scene scene = shipped_scene("cloth-hang");
  Scene other = scene;
  other.model.find<Springs>()->list[0].k *= 2;
  EXPECT_NE(error_of([&] {
              scene_toml(scene, other, 1e-12);
            }).find("cloth-hang: grid.stiffness.structural: expected a common value"),
            std::string::npos);
  other = scene;
  other.model.find<Gravity>()->acceleration *= 0.5;
  EXPECT_NE(error_of([&] { scene_toml(scene, other, 1e-12); }).find("gravity.acceleration"), std::string::npos);
}

}  // namespace
}  // namespace crosscheck
