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

/// Adds the springs' forces at x, N.
void add_spring_forces(const Scene& scene, const std::vector<Vec>& x, std::vector<Vec>& f) {
  const bool hooke = scene.spring_law == "hooke";
  for (const Spring& s : scene.springs) {
    const Vec d = x[s.a] - x[s.b];
    const double l = length(d);
    if (l == 0) continue;  // ends that meet get no force
    const Vec pull = (tension(s, hooke, l) / l) * d;
    f[s.a] = f[s.a] - pull;
    f[s.b] = f[s.b] + pull;
  }
}

/// What was really simulated: this engine steps on the scene's own lists, and has no dashpots, wind or spheres.
Readback read_back(const Scene& scene, double end, const std::vector<Vec>& x) {
  Readback r{scene.mass, scene.pinned, scene.springs, scene.gravity};
  r.drag = scene.drag;
  for (size_t i = 0; i < scene.mass.size(); ++i) (*r.drag)[i] /= scene.mass[i];
  r.spheres.emplace();
  r.may_sleep = false;
  r.step = scene.step;
  r.start_x = scene.x, r.start_v = scene.v;
  r.later = Places{end, {}, {}};
  for (int pin : scene.pins) r.later->pins.push_back(x[pin]);
  r.probe = probe_state(scene);
  const std::vector<Vec> none(scene.x.size(), Vec{});
  r.probe->springs = r.probe->dashpots = r.probe->wind = none;
  add_spring_forces(scene, r.probe->x, r.probe->springs);
  return r;
}

void simulate(const Scene& scene, const std::string& folder) {
  const double h = scene.step;
  std::vector<Vec> x = scene.x, v = scene.v, f(x.size());
  std::vector<std::vector<Vec>> frames{x}, speeds{v};
  const std::clock_t begin = std::clock();
  const long steps = static_cast<long>(scene.samples) * scene.steps_per_sample;
  for (long step = 1; step <= steps; ++step) {
    for (size_t i = 0; i < x.size(); ++i) f[i] = scene.mass[i] * scene.gravity - scene.drag[i] * v[i];
    add_spring_forces(scene, x, f);
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
  RunReport report;
  report.cpu_seconds = cpu, report.steps = steps, report.force_evaluations = steps;
  report.readback = read_back(scene, static_cast<double>(steps) * h, x);
  write_run_json(folder + "/run.json", report);
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
