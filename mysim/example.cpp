// A rope hung from its ends, run with the mysim library. Prints its lowest point and its loss of energy.
//   cmake: find_package(crosscheck REQUIRED), then target_link_libraries(rope PRIVATE crosscheck::mysim)
#include <algorithm>
#include <cstdio>
#include <exception>

#include "crosscheck/mysim.h"

int main() {
  // scene: eleven particles of 10 g on springs, the first and the last pinned
  mysim::Network rope;
  rope.gravity = {0, -9.81, 0};
  rope.drag = 2;
  for (int i = 0; i <= 10; ++i) rope.particles.push_back({{0.1 * i, 0, 0}, 0.01, {}, i == 0 || i == 10});
  for (int i = 0; i < 10; ++i) rope.springs.push_back({i, i + 1, 100, 0.1});

  try {
    const mysim::Scene scene = mysim::Scene::of(rope, 8);

    // observer: lowest particle and energy of each sample
    double lowest = 0, first = 0, last = 0;
    const auto look = [&](const mysim::Frame& frame) {
      lowest = 0;
      for (int i = 0; i < scene.particles(); ++i) lowest = std::min(lowest, frame.x[3 * i + 1]);
      last = mysim::energy(scene, frame).total();
      if (frame.t == 0) first = last;
      return true;
    };

    // run
    const mysim::Result result = mysim::run(scene, {.stepper = "leapfrog"}, look);
    std::printf("%s after %ld steps of %.3g s: it hangs %.4f m deep and has lost %.4f J\n", result.verdict.c_str(),
                result.steps, result.step, -lowest, first - last);
    return result.ok() ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
