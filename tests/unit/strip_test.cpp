// The sweep over regular cloth tested: it takes the same steps as the general engine, on every instruction set.
#include <gtest/gtest.h>

#include <cstdlib>

#include "experiments/bench/instructions.h"
#include "experiments/metrics.h"
#include "mysim/errors.h"
#include "mysim/strip/kernels.h"
#include "tests/unit/cloths.h"

namespace crosscheck::testing_tools {
namespace {

using strip::Isa;

TEST(Strip, TakesTheSameStepsAsTheGeneralEngine) {
  for (const Cloth& cloth : cloths()) {
    const Scene scene = scene_of(cloth);
    ASSERT_TRUE(weave_in(scene)) << cloth.name;
    for (const char* rule : rules_on_sheets) {
      const Trajectory plain = path_of(std::string(rule) + "+plain", scene);
      const double motion = motion_of(plain);
      // what 200 steps make of a perturbation, measured; summing in another order is one
      const double growth = perturbation_growth(find_method(std::string(rule) + "+plain"), scene, scene.step, 0.2);
      for (const Isa isa : strip::available()) {
        const Instructions only(isa);
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
    for (const char* rule : rules_on_sheets) {
      const Scene scene = scene_of(cloth);
      std::vector<Trajectory> paths;
      for (const Isa isa : {Isa::avx2, Isa::avx512}) {
        const Instructions only(isa);
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
  EXPECT_TRUE(weave_in(scene_of(cloth, "structural = 40")));
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

TEST(Strip, SingleSaysWhereItIsDouble) {
  for (const int columns : {20, 40}) {
    const Scene scene = scene_of({"", 5, columns, hang});
    const Outcome out = run_method(find_method("leapfrog+single"), scene, default_run(scene), {});
    EXPECT_EQ(out.remark.find("double precision") != std::string::npos, columns == 20) << out.remark;
  }
}

TEST(Strip, EndsThatMeetPullAtNothingAndAreCounted) {
  Scene scene = scene_of({"", 5, 20, hang});
  scene.start.x.col(45) = scene.start.x.col(46);
  scene.start.v.col(45) = scene.start.v.col(46);
  const crosscheck::Run run = default_run(scene);
  for (const char* rule : {"symplectic-euler", "leapfrog"}) {
    Recorder recorder;
    const Outcome plain = run_method(find_method(std::string(rule) + "+plain"), scene, run, {&recorder});
    ASSERT_GT(plain.coincident, 0);
    for (const Isa isa : strip::available()) {
      const Instructions only(isa);
      Recorder again;
      const Outcome out = run_method(find_method(rule), scene, run, {&again});
      EXPECT_EQ(out.coincident, plain.coincident) << name_of(isa);
      EXPECT_TRUE(again.trajectory.x.back().allFinite());
    }
  }
}

TEST(Strip, CountsAndObserversAreThoseOfTheGeneralEngine) {
  const Scene scene = scene_of(cloths()[0]);
  for (const char* rule : rules_on_sheets) {
    const crosscheck::Run run = default_run(scene);
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
      for (T& each : s) each = static_cast<T>(std::exp(random.between(std::log(low), std::log(high))));
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
  const Instructions as_before(Isa::sse2);  // afterwards
  setenv("CROSSCHECK_INSTRUCTIONS", "mmx", 1);
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
