// The sweep over regular cloth tested: it takes the same steps as the general engine, on every instruction set.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <set>

#include "experiments/metrics.h"
#include "experiments/scenes.h"
#include "mysim/errors.h"
#include "mysim/strip/kernels.h"
#include "mysim/strip/recognise.h"
#include "mysim/strip/sheet_body.h"
#include "tests/unit/helpers.h"

namespace crosscheck::testing_tools {
namespace {

using strip::Isa;

/// What CROSSCHECK_INSTRUCTIONS says for as long as this is there.
class Instructions {
 public:
  explicit Instructions(const std::string& name) { setenv("CROSSCHECK_INSTRUCTIONS", name.c_str(), 1); }
  ~Instructions() { unsetenv("CROSSCHECK_INSTRUCTIONS"); }
};

std::optional<strip::Weave> weave_in(const Scene& scene) {
  const auto* springs = scene.model.find<Springs>();
  return springs ? strip::weave_of(*springs, scene.model.particles.size(), scene.start.x.cwiseAbs().maxCoeff())
                 : std::nullopt;
}

struct Cloth {
  const char* name;
  int rows, columns;
  std::string more;             // of the scene's file
  void (*change)(Scene&) = {};  // what a file cannot say
};

Springs& springs_of(Scene& scene) {
  for (Term& term : scene.model.terms)
    if (auto* springs = std::get_if<Springs>(&term)) return *springs;
  throw std::logic_error("no springs");
}

/// A grid has two rows at least; one row is written spring by spring.
std::string one_row(int columns) {
  std::string text;
  for (int i = 0; i < columns; ++i) text += fmt::format("[[particle]]\nposition = [{}, 0, 0]\nmass = 0.01\n", 0.1 * i);
  for (const int skip : {1, 2})
    for (int i = 0; i + skip < columns; ++i)
      text +=
          fmt::format("[[spring]]\nends = [{}, {}]\nstiffness = {}\nrest = {}\n", i, i + skip, 40 / skip, 0.1 * skip);
  return text;
}

std::string text_of(const Cloth& cloth, const std::string& stiffness) {
  if (cloth.rows == 1) return one_row(cloth.columns) + cloth.more;
  return fmt::format(
      "[grid]\nsize = [{}, {}]\norigin = [-0.5, 0, 0]\nu = [1, 0, 0]\nv = [0, 0, {}]\nmass = 0.2\n"
      "[grid.stiffness]\n{}\n{}",
      cloth.columns, cloth.rows, (cloth.rows - 1) / (cloth.columns - 1.), stiffness, cloth.more);
}

/// A wave, so that springs pull from the first step on.
Scene scene_of(const Cloth& cloth, const std::string& stiffness = "structural = 40\nshear = 25\nbend = 10") {
  Scene scene = small_scene(text_of(cloth, stiffness), 0.2, 1e-3, 4);
  scene.window = 0.2;
  Random random(5);
  for (int i = 0; i < scene.start.x.cols(); ++i) {
    if (scene.model.particles.pinned[i]) continue;
    scene.start.x(1, i) += 0.02 * std::sin(7 * scene.start.x(0, i) + 5 * scene.start.x(2, i));
    for (double& v : scene.start.v.col(i)) v += random(-0.1, 0.1);
  }
  if (cloth.change) cloth.change(scene);
  return scene;
}

const std::string hang = "[pins]\nparticles = [0, 1]\n" + std::string(gravity_text);

/// Sizes around the lanes (three blocks of 8 or 16), one-row grids, and what rides along.
std::vector<Cloth> cloths() {
  return {
      {"17 columns: the fewest for double", 5, 17, hang},
      {"24: whole lanes", 4, 24, hang},
      {"25: one more", 6, 25, hang},
      {"one row", 1, 40, hang},
      {"two rows", 2, 33, hang},
      {"a tall one", 41, 19, hang},
      {"33: the fewest for single", 9, 33, hang + "[drag]\ngamma = 2\n"},
      {"51", 7, 51, hang + "[drag]\ncoefficient = 1e-3\n"},
      {"no pins, no gravity", 8, 24, ""},
      {"pins in the middle and at the ends", 6, 26,
       "[pins]\nparticles = [0, 25, 60, 77, 100, 130, 155]\n" + std::string(gravity_text)},
      {"moved pins", 5, 30,
       "[pins]\nparticles = [0, 29]\n[pins.motion]\namplitude = [0.1, 0, 0.05]\nfrequency = 3\nramp = 0.1\n" +
           std::string(gravity_text)},
      {"wind that comes and goes", 6, 20,
       hang + "[wind]\nacceleration = [3, 0, 1]\n[wind.gusts]\nvariation = 0.5\nside = [0, 1, 0]\nseed = 3\n"},
      {"masses of their own", 7, 22, hang + "[drag]\ncoefficient = 1e-3\n",
       [](Scene& scene) {
         for (int i = 0; i < scene.model.particles.size(); ++i) scene.model.particles.mass[i] *= 1 + 0.5 * std::sin(i);
       }},
      {"on a ball", 12, 24,
       std::string(gravity_text) +
           "[sphere]\ncentre = [0, -0.3, 0.25]\nradius = 0.28\nmargin = 0.01\nfriction = 0.3\n"},
      {"on a ball that moves", 12, 24,
       std::string(gravity_text) + "[sphere]\ncentre = [0, -0.3, 0.25]\nradius = 0.28\nmargin = 0.01\nfriction = 0.3\n"
                                   "[sphere.motion]\namplitude = [0.1, 0, 0]\nfrequency = 2\nramp = 0.1\n"},
  };
}

Trajectory path_of(const std::string& method, const Scene& scene) {
  Recorder recorder;
  Run run = default_run(scene);
  run.timed = false;
  const Outcome out = run_method(find_method(method), scene, run, {&recorder});
  EXPECT_EQ(out.verdict, Verdict::ok) << method << ": " << out.reason;
  return recorder.trajectory;
}

const char* const rules[] = {"symplectic-euler", "leapfrog", "suzuki4"};

TEST(Strip, TakesTheSameStepsAsTheGeneralEngine) {
  for (const Cloth& cloth : cloths()) {
    const Scene scene = scene_of(cloth);
    ASSERT_TRUE(weave_in(scene)) << cloth.name;
    for (const char* rule : rules) {
      const Trajectory plain = path_of(std::string(rule) + "+plain", scene);
      const double motion = motion_of(plain);
      // what 200 steps make of a perturbation, measured; summing in another order is one
      const double growth = perturbation_growth(find_method(std::string(rule) + "+plain"), scene, scene.step, 0.2);
      for (const Isa isa : strip::available()) {
        const Instructions with{std::string(name_of(isa))};
        for (const char* how : {"", "+fast", "+single"}) {
          const Trajectory path = path_of(std::string(rule) + how, scene);
          const bool single = std::string(how) == "+single";
          const double bound =
              single ? *single_precision_bound(scene, motion, growth, 200) : *round_off_bound(scene, motion, growth);
          EXPECT_LT(sup_distance(path, plain), bound) << cloth.name << ", " << rule << how << ", " << name_of(isa);
          ASSERT_EQ(path.v.size(), plain.v.size());
          for (size_t i = 0; i < path.v.size() && !single; ++i)
            EXPECT_LT(largest_column(path.v[i] - plain.v[i]), bound / scene.step) << cloth.name << ", " << rule << how;
        }
      }
    }
  }
}

TEST(Strip, ReproducibleIsTheSameBitsOnAvx2AndAvx512) {
  const auto all = strip::available();
  if (all.size() < 3) GTEST_SKIP() << "this machine has no AVX-512 to compare with";
  for (const Cloth& cloth : cloths())
    for (const char* rule : rules) {
      const Scene scene = scene_of(cloth);
      std::vector<Trajectory> paths;
      for (const Isa isa : {Isa::avx2, Isa::avx512}) {
        const Instructions with{std::string(name_of(isa))};
        paths.push_back(path_of(rule, scene));
      }
      for (int i = 0; i < paths[0].frames(); ++i) {
        EXPECT_EQ(paths[0].x[i], paths[1].x[i]) << cloth.name << ", " << rule;
        EXPECT_EQ(paths[0].v[i], paths[1].v[i]) << cloth.name << ", " << rule;
      }
    }
}

/// The scenes that the sweep is for are taken, and those that it cannot do are left alone.
TEST(Strip, RecognisesRegularCloths) {
  for (const char* name :
       {"cloth-hang", "cloth-swing", "cloth-sphere", "cloth-wind", "cloth-carried", "flag", "cloth-stiff"})
    EXPECT_TRUE(weave_in(load_scene(name))) << name;
  for (const char* name : {"jelly", "chain-link"}) EXPECT_FALSE(weave_in(load_scene(name))) << name;
  const Cloth cloth{"", 6, 20, hang};
  const auto weave = weave_in(scene_of(cloth));
  ASSERT_TRUE(weave);
  EXPECT_EQ(weave->rows, 6);
  EXPECT_EQ(weave->columns, 20);
  EXPECT_EQ(weave->families[0]->k, 40);
  EXPECT_EQ(weave->families[3]->k, 25);
  EXPECT_EQ(weave->families[5]->k, 10);
  // families may be missing
  EXPECT_TRUE(weave_in(scene_of(cloth, "structural = 40\nshear = 0\nbend = 0")));
  const struct {
    const char* what;
    void (*change)(std::vector<Spring>&);
  } damages[] = {
      {"a hole", [](std::vector<Spring>& list) { list.erase(list.begin() + 40); }},
      {"a stiffer spring", [](std::vector<Spring>& list) { list[33].k *= 1.001; }},
      {"a longer spring", [](std::vector<Spring>& list) { list[33].rest *= 1 + 1e-9; }},
      {"a spring twice", [](std::vector<Spring>& list) { list.push_back(list[7]); }},
      {"a thread across",
       [](std::vector<Spring>& list) {
         list.push_back({0, 50, 40, 1, Family::single});
       }},
  };
  for (const auto& [what, change] : damages) {
    Scene scene = scene_of(cloth);
    change(springs_of(scene).list);
    EXPECT_FALSE(weave_in(scene)) << what;
    // silently right: the same answer with and without being asked for the general engine
    EXPECT_EQ(path_of("leapfrog", scene).x.back(), path_of("leapfrog+plain", scene).x.back()) << what;
  }
}

TEST(Strip, EndsThatMeetPullAtNothingAndAreCounted) {
  Scene scene = scene_of({"", 5, 20, hang});
  scene.start.x.col(45) = scene.start.x.col(46);
  scene.start.v.col(45) = scene.start.v.col(46);
  Run run = default_run(scene);
  for (const char* rule : {"symplectic-euler", "leapfrog"}) {
    Recorder recorder;
    const Outcome plain = run_method(find_method(std::string(rule) + "+plain"), scene, run, {&recorder});
    ASSERT_GT(plain.coincident, 0);
    for (const Isa isa : strip::available()) {
      const Instructions with{std::string(name_of(isa))};
      Recorder again;
      const Outcome out = run_method(find_method(rule), scene, run, {&again});
      EXPECT_EQ(out.coincident, plain.coincident) << name_of(isa);
      EXPECT_TRUE(again.trajectory.x.back().allFinite());
    }
  }
}

TEST(Strip, CountsAndObserversAreThoseOfTheGeneralEngine) {
  const Scene scene = scene_of(cloths()[0]);
  for (const char* rule : rules) {
    const Run run = default_run(scene);
    Recorder plain, sheet;
    const Outcome a = run_method(find_method(std::string(rule) + "+plain"), scene, run, {&plain}),
                  b = run_method(find_method(rule), scene, run, {&sheet});
    EXPECT_EQ(a.evaluations, b.evaluations);
    EXPECT_EQ(a.steps, b.steps);
    EXPECT_EQ(plain.trajectory.t, sheet.trajectory.t);
    EXPECT_EQ(plain.trajectory.x.front(), sheet.trajectory.x.front()) << "the start is the scene's";
    for (const int pin : scene.model.particles.pins)
      EXPECT_EQ(plain.trajectory.x.back().col(pin), sheet.trajectory.x.back().col(pin));
  }
}

template <class T>
void expect_good_roots(double low, double high) {
  Random random(11);
  for (const Isa isa : strip::available())
    for (const bool fast : {false, true}) {
      double worst = 0;
      std::vector<T> s(1 << 16), y(s.size());
      for (T& each : s) each = static_cast<T>(std::exp(random(std::log(low), std::log(high))));
      strip::kernel<T>(isa, fast).inverse_roots(s.data(), y.data(), static_cast<long>(s.size()));
      for (size_t i = 0; i < s.size(); ++i) {
        const long double exact = 1 / std::sqrt(static_cast<long double>(s[i]));
        const T near = static_cast<T>(exact);
        const long double ulp = static_cast<long double>(std::nextafter(near, T(INFINITY))) - near;
        worst = std::max(worst, static_cast<double>(std::abs(static_cast<long double>(y[i]) - exact) / ulp));
      }
      EXPECT_LE(worst, sizeof(T) == 8 ? 2 : 4) << name_of(isa) << (fast ? ", fast" : "");
    }
}

TEST(Strip, InverseRootsAreGoodToTwoUnitsInTheLastPlace) {
  expect_good_roots<double>(1e-12, 1e12);
  expect_good_roots<float>(1e-12, 1e12);
}

TEST(Strip, InstructionsThatAreNotThereAreNamed) {
  const Instructions with("mmx");
  try {
    path_of("leapfrog", scene_of(cloths()[0]));
    ADD_FAILURE() << "it ran";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("CROSSCHECK_INSTRUCTIONS=mmx: expected sse2, avx2 or avx512"),
              std::string::npos);
  }
}

}  // namespace
}  // namespace crosscheck::testing_tools
