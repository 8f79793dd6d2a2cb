// The sweep on several threads, and what it tells: the same as on one.
#include <gtest/gtest.h>

#include <array>
#include <chrono>

#include "experiments/metrics.h"
#include "mysim/clock.h"
#include "mysim/strip/crew.h"
#include "tests/unit/cloths.h"

namespace crosscheck::testing_tools {
namespace {

/// Large enough for the threads asked for; what rides along reaches into the rows beside every border.
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

TEST(Strip, ThreadsChangeNoBit) {
  for (const Cloth& cloth : large_cloths()) {
    Scene scene = scene_of(cloth);
    scene.duration = 0.02, scene.samples = 2, scene.step = 2e-4;
    for (const std::string rule : {"leapfrog", "leapfrog+single", "suzuki4"}) {
      if (cloth.rows == 128 && rule == "suzuki4") continue;  // spheres are left to the general engine there
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

TEST(Crew, CountsWhatTheOthersWork) {
  strip::Crew crew(3);
  std::array<double, 3> own{};
  for (int round = 0; round < 5; ++round)
    crew.all([&](int which) {
      CpuClock clock;
      double s = 0;
      while (s < (which == 0 ? 20e-3 : 1e-3)) clock.start(), clock.stop(), s = clock.seconds();
      own[which] += s;
    });
  // the reading of clocks comes on top; what the first did is twenty times as much
  EXPECT_GE(crew.seconds(), own[1] + own[2]);
  EXPECT_LT(crew.seconds(), own[0]);
}

TEST(Crew, AsleepItWakesUp) {
  strip::Crew crew(2);
  for (int round = 0; round < 3; ++round) {
    std::atomic<int> sum = 0;
    crew.all([&](int which) { sum += which + 1; });
    EXPECT_EQ(sum, 3);
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
  }
}

}  // namespace
}  // namespace crosscheck::testing_tools
