// The fused step of regular cloths takes the same steps as the general engine, on every instruction set and with
// several threads.

#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cstdlib>

#include "experiments/metrics.h"
#include "experiments/timing/instruction_sets.h"
#include "mysim/base/errors.h"
#include "mysim/base/this_process.h"
#include "mysim/simd/cloth_grid/cloth_grid.h"
#include "mysim/simd/thread_pool.h"
#include "tests/unit/experiments/cloths.h"
#include "tests/unit/reference/helpers.h"

namespace crosscheck::testing_tools {
namespace {

using simd::InstructionSet;

TEST(ClothGrid, TakesTheSameStepsAsTheGeneralEngine) {
  for (const Cloth& cloth : cloths()) {
    const Scene scene = scene_of(cloth);
    ASSERT_TRUE(grid_topology_in(scene)) << cloth.name;
    for (const char* rule : fused_rules) {
      const Trajectory plain = path_of(std::string(rule) + "+plain", scene);
      const double motion = motion_of(plain);
      // A different summation order is equivalent to a perturbation, whose growth is measured over 200 steps.
      const double growth = perturbation_growth(find_method(std::string(rule) + "+plain"), scene, scene.step, 0.2);
      for (const InstructionSet isa : simd::supported_instruction_sets()) {
        const ScopedInstructionSet only(isa);
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

TEST(ClothGrid, ReproducibleIsTheSameBitsOnAvx2AndAvx512) {
  const auto all = simd::supported_instruction_sets();
  if (all.size() < 3) GTEST_SKIP() << "this machine has no AVX-512";
  for (const Cloth& cloth : cloths())
    for (const char* rule : fused_rules) {
      const Scene scene = scene_of(cloth);
      std::vector<Trajectory> paths;
      for (const InstructionSet isa : {InstructionSet::avx2, InstructionSet::avx512}) {
        const ScopedInstructionSet only(isa);
        paths.push_back(path_of(rule, scene));
      }
      for (int i = 0; i < paths[0].frames(); ++i) {
        EXPECT_EQ(paths[0].x[i], paths[1].x[i]) << cloth.name << ", " << rule;
        EXPECT_EQ(paths[0].v[i], paths[1].v[i]) << cloth.name << ", " << rule;
      }
    }
}

/// Contacts are resolved in SIMD lanes if there is no ledger, and otherwise by the rule of terms/surface.h. The results
/// agree bit for bit for one ball, for two balls, and for a ball and a plane that touch the same particles. The
/// particles slide, stick, hit at speed, or bounce.
TEST(ClothGrid, ContactsInLanesHaveTheBitsOfTheRule) {
  std::string cloth = load_scene("cloth-sphere").source;
  cloth.erase(cloth.find("[sphere]"));
  const char* second = "[[sphere]]\ncentre = [0.5, -0.2, 0.3]\nradius = 1\nmargin = 0.02\nfriction = 0.2\n";
  const char* plane =
      "[[plane]]\npoint = [0, 0.95, 0]\nnormal = [0.2, 1, 0.1]\nmargin = 0.02\nfriction = 0.3\nrestitution = 0.2\n";
  for (const char* second_solid : {"", second, plane})
    for (const double friction : {0., 0.5, 50.})
      for (const double restitution : {0., 0.7}) {
        const Scene scene = parse_scene(
            fmt::format(
                "{}[[sphere]]\ncentre = [0, 0, 0]\nradius = 1\nmargin = 0.02\nfriction = {}\nrestitution = {}\n{}",
                cloth, friction, restitution, second_solid),
            "cloth.toml", "cloth");
        for (const char* rule : {"leapfrog", "symplectic-euler"}) {
          if (rule[0] == 's' && friction != 0.5) continue;
          for (const InstructionSet isa : simd::supported_instruction_sets()) {
            const ScopedInstructionSet only(isa);
            const crosscheck::Run run{scene.step, 0.6, 30};
            Recorder in_lanes, one_by_one;
            Ledger ledger(scene.model, ContactLoss::reported);
            run_method(find_method(rule), scene, run, {&in_lanes});
            run_method(find_method(rule), scene, run, {&one_by_one, &ledger});
            ASSERT_EQ(in_lanes.trajectory.frames(), one_by_one.trajectory.frames());
            bool touched = false;
            for (int i = 0; i < in_lanes.trajectory.frames(); ++i) {
              touched |= clearance(scene, in_lanes.trajectory.t[i], in_lanes.trajectory.x[i]).value_or(1) < 1e-9;
              ASSERT_EQ(in_lanes.trajectory.x[i], one_by_one.trajectory.x[i])
                  << rule << ", " << name_of(isa) << ", friction " << friction << ", restitution " << restitution;
              ASSERT_EQ(in_lanes.trajectory.v[i], one_by_one.trajectory.v[i]) << rule << ", " << name_of(isa);
            }
            EXPECT_TRUE(touched);
          }
        }
      }
}

TEST(ClothGrid, RecognisesRegularCloths) {
  for (const char* name :
       {"cloth-hang", "cloth-swing", "cloth-sphere", "cloth-wind", "cloth-carried", "flag", "cloth-stiff"})
    EXPECT_TRUE(grid_topology_in(load_scene(name))) << name;
  for (const char* name : {"jelly", "chain-link"}) EXPECT_FALSE(grid_topology_in(load_scene(name))) << name;
  const Cloth cloth{"", 6, 20, hang};
  const auto topology = grid_topology_in(scene_of(cloth));
  ASSERT_TRUE(topology);
  EXPECT_EQ(topology->rows, 6);
  EXPECT_EQ(topology->columns, 20);
  EXPECT_EQ(topology->families[0]->k, 40);
  EXPECT_EQ(topology->families[3]->k, 25);
  EXPECT_EQ(topology->families[5]->k, 10);
  // any family of springs may be missing
  EXPECT_TRUE(grid_topology_in(scene_of(cloth, "structural = 40")));
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
    EXPECT_FALSE(grid_topology_in(scene)) << what;
    EXPECT_EQ(path_of("leapfrog", scene).x.back(), path_of("leapfrog+plain", scene).x.back()) << what;
  }
}

TEST(ClothGrid, SingleSaysWhereItIsDouble) {
  for (const int columns : {16, 17, 32, 33}) {
    const Scene scene = scene_of({"", 5, columns, hang});
    const Outcome out = run_method(find_method("leapfrog+single"), scene, default_run(scene), {});
    EXPECT_EQ(out.remark.find("double precision") != std::string::npos, columns == 16) << out.remark;
  }
}

TEST(ClothGrid, EndsThatMeetPullAtNothingAndAreCounted) {
  Scene scene = scene_of({"", 5, 20, hang});
  scene.start.x.col(45) = scene.start.x.col(46);
  scene.start.v.col(45) = scene.start.v.col(46);
  const crosscheck::Run run = default_run(scene);
  for (const char* rule : {"symplectic-euler", "leapfrog"}) {
    Recorder recorder;
    const Outcome plain = run_method(find_method(std::string(rule) + "+plain"), scene, run, {&recorder});
    ASSERT_GT(plain.degenerate_springs, 0);
    for (const InstructionSet isa : simd::supported_instruction_sets()) {
      const ScopedInstructionSet only(isa);
      Recorder again;
      const Outcome out = run_method(find_method(rule), scene, run, {&again});
      EXPECT_EQ(out.degenerate_springs, plain.degenerate_springs) << name_of(isa);
      EXPECT_TRUE(again.trajectory.x.back().allFinite());
    }
  }
}

TEST(ClothGrid, CountsAndObserversAreThoseOfTheGeneralEngine) {
  const Scene scene = scene_of(cloths()[0]);
  for (const char* rule : fused_rules) {
    const crosscheck::Run run = default_run(scene);
    Recorder plain, fused;
    const Outcome a = run_method(find_method(std::string(rule) + "+plain"), scene, run, {&plain}),
                  b = run_method(find_method(rule), scene, run, {&fused});
    EXPECT_EQ(a.evaluations, b.evaluations);
    EXPECT_EQ(a.steps, b.steps);
    EXPECT_EQ(plain.trajectory.t, fused.trajectory.t);
    EXPECT_EQ(plain.trajectory.x.front(), fused.trajectory.x.front()) << "the initial state is the scene's";
    for (const int pin : scene.model.particles.pins)
      EXPECT_EQ(plain.trajectory.x.back().col(pin), fused.trajectory.x.back().col(pin));
  }
}

template <class T>
void expect_good_roots(double low, double high) {
  Random random(11);
  for (const InstructionSet isa : simd::supported_instruction_sets())
    for (const bool fast : {false, true}) {
      double worst = 0;
      std::vector<T> s(1 << 16), y(s.size());
      for (T& each : s) each = static_cast<T>(std::exp(random.between(std::log(low), std::log(high))));
      simd::kernel<T>(isa, fast).rsqrt_array(s.data(), y.data(), static_cast<long>(s.size()));
      for (size_t i = 0; i < s.size(); ++i) {
        const long double exact = 1 / std::sqrt(static_cast<long double>(s[i]));
        const T near = static_cast<T>(exact);
        const long double ulp = static_cast<long double>(std::nextafter(near, T(INFINITY))) - near;
        worst = std::max(worst, static_cast<double>(std::abs(static_cast<long double>(y[i]) - exact) / ulp));
      }
      EXPECT_LE(worst, sizeof(T) == 8 ? 2 : 4) << name_of(isa) << (fast ? ", fast" : "");
    }
}

TEST(ClothGrid, InverseRootsAreGoodToTwoUnitsInTheLastPlace) {
  expect_good_roots<double>(1e-12, 1e12);
  expect_good_roots<float>(1e-12, 1e12);
}

TEST(ClothGrid, InstructionsThatAreNotThereAreNamed) {
  const ScopedInstructionSet as_before(InstructionSet::baseline);  // restores the variable
  setenv("CROSSCHECK_INSTRUCTIONS", "mmx", 1);
  try {
    path_of("leapfrog", scene_of(cloths()[0]));
    ADD_FAILURE() << "expected an error";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("CROSSCHECK_INSTRUCTIONS=mmx: expected baseline, avx2 or avx512"),
              std::string::npos);
  }
}

/// Cloths large enough for the requested threads. The other terms affect the rows next to every border between threads.
std::vector<Cloth> large_cloths() {
  return {
      {"hangs and is carried", 131, 101,
       "[pins]\nparticles = [0, 3300, 6600, 6700, 13230]\n[pins.motion]\namplitude = [0.1, 0, 0.05]\nfrequency = 3\n"
       "ramp = 0.1\n[drag]\ngamma = 2\n" +
           std::string(gravity_text)},
      {"falls on a ball", 128, 97,
       std::string(gravity_text) +
           "[sphere]\ncentre = [0, -0.335, 0.65]\nradius = 0.3\nmargin = 0.01\nfriction = 0.3\n",
       [](Scene& scene) { scene.model.particles.mass.array() *= 1 + 0.5 * scene.start.x.row(0).transpose().array(); }},
  };
}

TEST(ClothGrid, ThreadsChangeNoBit) {
  for (const Cloth& cloth : large_cloths()) {
    Scene scene = scene_of(cloth);
    scene.duration = 0.02, scene.samples = 2, scene.step = 2e-4;
    for (const std::string rule : {"leapfrog", "leapfrog+single", "suzuki4"}) {
      if (cloth.rows == 128 && rule == "suzuki4") continue;  // the general engine handles spheres in suzuki4
      const Trajectory one = path_of(rule, scene);
      EXPECT_GT(motion_of(one), 1e-4) << cloth.name;
      for (const char* threads : {"+threads=2", "+threads=3"}) {
        const Trajectory more = path_of(rule + threads, scene);
        for (int i = 0; i < one.frames(); ++i) {
          EXPECT_EQ(one.x[i], more.x[i]) << cloth.name << ", " << rule << threads;
          EXPECT_EQ(one.v[i], more.v[i]) << cloth.name << ", " << rule << threads;
        }
      }
    }
  }
}

TEST(ThreadPool, CountsWhatTheOthersWork) {
  simd::ThreadPool pool(3);
  std::array<double, 3> own{};
  for (int round = 0; round < 5; ++round)
    pool.all([&](int which) {
      CpuClock clock;
      double s = 0;
      while (s < (which == 0 ? 20e-3 : 1e-3)) {
        clock.start();
        for (volatile int i = 0; i < 1000;) i = i + 1;
        clock.stop();
        s = clock.seconds();
      }
      own[which] += s;
    });
  // The pool also counts the time of clock reads. The first thread has twenty times as much work as each of the others.
  EXPECT_GE(pool.seconds(), own[1] + own[2]);
  EXPECT_LT(pool.seconds(), own[0]);
}

TEST(ThreadPool, AsleepItWakesUp) {
  simd::ThreadPool pool(2);
  for (int round = 0; round < 3; ++round) {
    std::atomic<int> sum = 0;
    pool.all([&](int which) { sum += which + 1; });
    EXPECT_EQ(sum, 3);
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
  }
}

}  // namespace
}  // namespace crosscheck::testing_tools
