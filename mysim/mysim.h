// mysim as a library: create or read a scene, run it with a stepper, observe its states. This header is the complete
// public interface; example.cpp simulates a rope. SI units throughout: m, kg, s, N.
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

/// Invalid input, or a stepper that cannot run the scene. what() states in one line what was expected.
struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Particles and springs from which Scene::of() makes a scene without a file.
struct Network {
  struct Particle {
    std::array<double, 3> position;              // m, initial
    double mass;                                 // kg
    std::array<double, 3> velocity = {0, 0, 0};  // m/s, initial
    bool pinned = false;                         // fixed at its initial position
  };
  struct Spring {
    int a, b;            // particle indices
    double stiffness;    // N/m, Hooke's law
    double rest;         // m
    double dashpot = 0;  // N s/m, along the spring
  };
  std::vector<Particle> particles;
  std::vector<Spring> springs;
  std::array<double, 3> gravity = {0, 0, 0};  // m/s^2
  double drag = 0;                            // 1/s: the force on a particle is -drag m v
};

/// The problem to simulate: particles, springs, pins, forces, initial state, and the default times of a run. Copies
/// share their data.
class Scene {
 public:
  /// Reads a scene file (TOML, keys in experiments/scenes/README.md). Throws Error: "FILE:LINE: KEY: expected ...".
  static Scene read(const std::string& file);
  /// Parses the text of a scene file. All ingredients are available: cloth grids, wind, spheres with friction.
  static Scene parse(std::string_view toml, const std::string& name);
  /// `duration` (s): default duration of runs.
  static Scene of(const Network& network, double duration);

  int particles() const;
  double step() const;      // s, the scene's default; for networks, 1/20 of the shortest vibration period
  double duration() const;  // s
  /// End points of springs, and triangles of cloth, for drawing.
  std::vector<std::pair<int, int>> springs() const;
  const std::vector<std::array<int, 3>>& triangles() const;

  /// The internal type, for code in mysim's source tree (mysim/scene/scene.h).
  const crosscheck::Scene& inner() const { return *scene_; }

 private:
  explicit Scene(crosscheck::Scene scene);
  std::shared_ptr<const crosscheck::Scene> scene_;
};

/// A state of a run, valid only during the call of the observer.
struct Frame {
  double t;                   // s
  std::span<const double> x;  // m: components x[3 i], x[3 i + 1], x[3 i + 2] of particle i
  std::span<const double> v;  // m/s, in the layout of x; empty for first-order scenes
  bool sample;                // one of the equally spaced samples, not a step between them (Settings::every_step)
};

struct Settings {
  std::string stepper = "leapfrog";  // one of steppers()
  double step = 0;          // s, upper bound, reduced to divide the time between samples; 0 for the scene's default
  double tolerance = 1e-6;  // relative, for adaptive steppers (dopri5)
  double duration = 0;      // s; 0: the scene's default
  int samples = 0;          // frames after the first, at i duration / samples; 0 for the scene's default
  bool every_step = false;  // call the observer after every step
};

struct Result {
  std::string verdict;      // "ok", "stopped", or the kind of failure: "energy", "nan", "stretch", "solver", "frozen"
  std::string reason;       // one sentence if the run failed
  double end;               // s, last time
  double step;              // s, as used
  long steps, evaluations;  // steps taken, and evaluations of the right-hand side
  double cpu_seconds;       // s, stepping only, without observers
  bool ok() const { return verdict == "ok"; }
};

/// Receives the initial state, then the samples or every step; returning false ends the run with verdict "stopped".
using Observer = std::function<bool(const Frame&)>;

/// Runs the scene. A run that diverges ends early, and the result states how. Throws Error for unknown steppers,
/// impossible settings, and scenes that the stepper cannot run.
Result run(const Scene& scene, const Settings& settings = {}, const Observer& observer = {});

/// Energy of a state by the scene's formulas (J). The gravitational energy is relative to the origin. Undefined for
/// first-order scenes.
struct Energy {
  double kinetic, elastic, gravitational;
  double total() const { return kinetic + elastic + gravitational; }
};
Energy energy(const Scene& scene, const Frame& frame);

std::vector<std::string> steppers();

}  // namespace mysim
