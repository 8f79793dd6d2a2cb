// An engine for crosscheck in C++17: symplectic Euler with springs, drag, gravity and moved pins. Build it with any
// compiler: c++ -std=c++17 -O2 example_engine.cpp -o engine

#include <cstdio>
#include <ctime>

#include "crosscheck_engine.h"

using namespace crosscheck_engine;

namespace {

/// Tension of a spring of this length (m), N.
double tension(const Spring& s, bool hooke, double l) {
  const double r = s.rest_length;
  return hooke ? s.stiffness * (l - r) : s.stiffness * l * (l * l - r * r) / (l * l + r * r);
}

void simulate(const Scene& scene, const std::string& folder) {
  const bool hooke = scene.spring_law == "hooke";
  const double h = scene.step;
  std::vector<Vec> x = scene.x, v = scene.v, f(x.size());
  std::vector<std::vector<Vec>> frames{x}, speeds{v};
  const std::clock_t begin = std::clock();
  const long steps = static_cast<long>(scene.samples) * scene.steps_per_sample;
  for (long step = 1; step <= steps; ++step) {
    for (size_t i = 0; i < x.size(); ++i) f[i] = scene.mass[i] * scene.gravity - scene.drag[i] * v[i];
    for (const Spring& s : scene.springs) {
      const Vec d = x[s.a] - x[s.b];
      const double l = length(d);
      if (l == 0) continue;  // ends that meet get no force
      const Vec pull = (tension(s, hooke, l) / l) * d;
      f[s.a] = f[s.a] - pull;
      f[s.b] = f[s.b] + pull;
    }
    for (size_t i = 0; i < x.size(); ++i) {
      v[i] = v[i] + (h / scene.mass[i]) * f[i];
      x[i] = x[i] + h * v[i];
    }
    scene.place_pins(static_cast<double>(step) * h, x, v);
    if (step % scene.steps_per_sample == 0) frames.push_back(x), speeds.push_back(v);
  }
  const double cpu = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  write_npy(folder + "/trajectory.npy", frames);
  write_npy(folder + "/velocities.npy", speeds);
  const Readback readback{scene.mass, scene.pinned, scene.springs, scene.gravity};
  write_run_json(folder + "/run.json", cpu, steps, steps, &readback);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc != 3) throw std::runtime_error("expected: example_engine scene.json FOLDER");
    const Scene scene = read_scene(argv[1]);
    scene.require_only({"springs", "drag", "gravity"});
    simulate(scene, argv[2]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
