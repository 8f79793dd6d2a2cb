// mysim as a library: make or read a scene, run it by a stepper, observe its states. This header is all there is to
// know; example.cpp beside the documentation makes a rope and runs it. SI units everywhere: m, kg, s, N.
//
//   mysim::Scene scene = mysim::Scene::read("cloth-hang.toml");
//   mysim::Result result = mysim::run(scene, {.stepper = "leapfrog", .step = 5e-4}, [](const mysim::Frame& frame) {
//     return frame.x[1] > -2;  // the height of particle 0; false ends the run
//   });
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace crosscheck {
struct Scene;
}

namespace mysim {

/// Bad input, or a stepper that lacks what the scene asks for. what() is one line that says what was expected.
struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A net of particles and springs, to make a scene of without a file.
struct Network {
  struct Particle {
    std::array<double, 3> position;              // m, at the start
    double mass;                                 // kg
    std::array<double, 3> velocity = {0, 0, 0};  // m/s, at the start
    bool pinned = false;                         // held where it is
  };
  struct Spring {
    int a, b;            // its ends, as indices of particles
    double stiffness;    // N/m, Hooke's law
    double rest;         // m
    double dashpot = 0;  // N s/m, along the spring
  };
  std::vector<Particle> particles;
  std::vector<Spring> springs;
  std::array<double, 3> gravity = {0, 0, 0};  // m/s^2
  double drag = 0;                            // 1/s: the force on a particle is -drag m v
};

/// What is simulated: particles, springs, pins, forces, the state at the start, and the times of a run. Copies share
/// it.
class Scene {
 public:
  /// A scene file (TOML); experiments/scenes/README.md has its keys. Throws Error: "FILE:LINE: KEY: expected ...".
  static Scene read(const std::string& file);
  /// The same from text, of any ingredients that a file may have: grids of cloth, wind, spheres with friction.
  static Scene parse(std::string_view toml, const std::string& name);
  /// A scene of particles and springs. Runs take `duration` s unless they say otherwise.
  static Scene of(const Network& network, double duration);

  int particles() const;
  double step() const;      // s, the scene's own; of networks a twentieth of the fastest vibration's period
  double duration() const;  // s
  /// Springs as pairs of ends, and triangles of cloth, for drawing.
  std::vector<std::pair<int, int>> springs() const;
  const std::vector<std::array<int, 3>>& triangles() const;

  /// mysim's own type, for code that is compiled in its source tree (mysim/scene/scene.h).
  const crosscheck::Scene& inner() const { return *scene_; }

 private:
  explicit Scene(crosscheck::Scene scene);
  std::shared_ptr<const crosscheck::Scene> scene_;
};

/// A state of a run; valid while the observer is called.
struct Frame {
  double t;                   // s
  std::span<const double> x;  // m: x[3 i], x[3 i + 1], x[3 i + 2] of particle i
  std::span<const double> v;  // m/s, in the same order; empty in scenes of order 1
  bool sample;                // one of the equally spaced states; else one between them (Settings::every_step)
};

struct Settings {
  std::string stepper = "leapfrog";  // one of steppers()
  double step = 0;          // s, at most: it is reduced so that it divides the time between samples; 0: the scene's
  double tolerance = 1e-6;  // relative, of steppers that choose their own steps (dopri5)
  double duration = 0;      // s; 0: the scene's
  int samples = 0;          // frames after the first, at i duration / samples; 0: the scene's
  bool every_step = false;  // the observer sees every step
};

struct Result {
  std::string verdict;      // "ok"; or how the run failed: "energy", "nan", "stretch", "solver", "frozen"; or "stopped"
  std::string reason;       // one sentence where it failed
  double end;               // s, the last time reached
  double step;              // s, as used
  long steps, evaluations;  // of the right-hand side
  double cpu_seconds;       // of the steps alone, observers excluded
  bool ok() const { return verdict == "ok"; }
};

/// Sees the start and the samples, or every step. False ends the run, with the verdict "stopped".
using Observer = std::function<bool(const Frame&)>;

/// Runs the scene. A run that diverges is no exception: it ends, and the result says how. Throws Error for unknown
/// steppers, impossible settings, and where the stepper cannot run the scene.
Result run(const Scene& scene, const Settings& settings = {}, const Observer& observer = {});

/// Energy of a state by the scene's formulas, J: gravity's is zero at the origin. Not of scenes of order 1.
struct Energy {
  double kinetic, elastic, gravitational;
  double total() const { return kinetic + elastic + gravitational; }
};
Energy energy(const Scene& scene, const Frame& frame);

/// The names of all steppers.
std::vector<std::string> steppers();

}  // namespace mysim
