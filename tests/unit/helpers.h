#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "mysim/base/errors.h"
#include "mysim/base/random.h"
#include "mysim/run/engine.h"
#include "mysim/run/observers.h"
#include "mysim/scene/scene.h"

namespace crosscheck::testing_tools {

// Shared by unit tests: seeded random numbers, small scenes, shipped scenes by name, runs, and distances over time.

inline constexpr double eps = std::numeric_limits<double>::epsilon();

/// Random numbers that are the same with every standard library.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double between(double low, double high) { return low + (high - low) * uniform(engine_); }
  Vec3 vector() {  // components in [-1, 1], drawn in a fixed order
    Vec3 v;
    for (double& part : v) part = between(-1, 1);
    return v;
  }

 private:
  std::mt19937_64 engine_;
};

inline const Stepper& stepper(std::string_view name) {
  for (const Stepper& s : steppers())
    if (s.name == name) return s;
  throw std::out_of_range("no stepper " + std::string(name));
}

inline Stepper at_fixed_step(Stepper s) {
  s.adaptive = false;
  return s;
}
inline std::vector<Stepper> fixed_steppers() {
  std::vector<Stepper> list;
  for (const Stepper& s : steppers()) list.push_back(at_fixed_step(s));
  return list;
}

inline bool takes(const Stepper& s, const Scene& scene) {
  return (!scene.model.first_order() || s.first_order) && (!scene.model.find<Constraints>() || s.hard_constraints);
}

/// The mandatory header of a scene file, followed by `more`, which contains particles and terms.
inline std::string scene_text(const std::string& more, double duration = 1, double step = 1e-3, int samples = 10) {
  return fmt::format(
             "question = \"q\"\nparameters = \"p\"\n[time]\nduration = {}\nsamples = {}\nstep = {}\nwindow = {}\n"
             "tolerance = 1e-3\nmethod = \"leapfrog\"\n",
             duration, samples, step, duration) +
         more;
}
inline Scene small_scene(const std::string& more, double duration = 1, double step = 1e-3, int samples = 10) {
  return parse_scene(scene_text(more, duration, step, samples), "small");
}

inline std::filesystem::path shipped_scene_folder() { return CROSSCHECK_SOURCE "/experiments/scenes"; }
inline Scene shipped_scene(const std::string& name) { return read_scene(shipped_scene_folder() / (name + ".toml")); }
/// Sorted.
inline std::vector<std::string> shipped_scene_names() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(shipped_scene_folder()))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem());
  std::sort(names.begin(), names.end());
  return names;
}

/// Message of the InputError that the text of a scene causes, or "" if the scene is valid.
inline std::string message_of(const std::string& text) {
  try {
    parse_scene(text, "bad.toml");
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

inline constexpr auto gravity_text = "[gravity]\nacceleration = [0, -9.81, 0]\n";

/// A cloth of 5 x 5 particles whose upper edge is pinned and moves, in gusts, with drag. It has every smooth ingredient
/// except those of small_cloth_in_air. `of_grid`: more lines for the [grid] table.
inline Scene small_cloth(const std::string& of_grid = "") {
  return small_scene("[grid]\nsize = [5, 5]\norigin = [-0.5, 0, 0]\nu = [1, 0, 0]\nv = [0, -0.9, 0.4]\n" + of_grid +
                     std::string("mass = 0.25\n[grid.stiffness]\nstructural = 40\nshear = 30\nbend = 20\n"
                                 "[pins]\nparticles = [0, 1, 2, 3, 4]\n[pins.motion]\namplitude = [0, 0, 0.1]\n"
                                 "frequency = 1\nramp = 0.25\n[drag]\ngamma = 2\n"
                                 "[wind]\nacceleration = [0, 0, 3]\n[wind.gusts]\nvariation = 1\nside = [1, 0, 0]\n"
                                 "seed = 3\n") +
                     gravity_text);
}

/// The scene small_cloth with bending and dashpots, and with streaming air instead of wind.
inline Scene small_cloth_in_air() {
  Scene scene = small_cloth("bending = 0.1\n");
  std::erase_if(scene.model.terms, [](const Term& t) { return std::holds_alternative<Wind>(t); });
  Dashpots dashpots;
  for (const Spring& s : scene.model.find<Springs>()->list) dashpots.list.push_back({s.a, s.b, 0.01});
  const WindSignal air{{0, 0, 2}, WindSignal::Gusts{0.5, {1, 0, 0}, 3, Gust(3, 1), Gust(3, 2)}};
  scene.model.terms.emplace_back(dashpots);
  scene.model.terms.emplace_back(Aerodynamics{1.2, 1, air, scene.triangles});
  return scene;
}

inline Scene without_drag(Scene scene) {
  std::erase_if(scene.model.terms, [](const Term& t) { return std::holds_alternative<Drag>(t); });
  return scene;
}
inline Scene with_drag(Scene scene, double gamma) {
  scene.model.terms.emplace_back(Drag{gamma * scene.model.particles.mass});
  return scene;
}

/// Runs a rule of mysim with Coulomb contact and without a divergence monitor.
inline Trajectory trajectory_of(const Stepper& s, const Scene& scene, const Run& run) {
  Recorder recorder;
  simulate(s, ContactRule::coulomb, scene, run, recorder);
  return recorder.trajectory;
}

/// Largest RMS distance (m) over time. Both runs must have the same samples. Ignores samples after `until` (s).
inline double sup_rms(const Trajectory& a, const Trajectory& b, double until = INFINITY) {
  EXPECT_EQ(a.frames(), b.frames());
  double largest = 0;
  for (int i = 0; i < std::min(a.frames(), b.frames()) && a.t[i] <= until * (1 + 1e-9); ++i) {
    const double d = rms_distance(a.x[i], b.x[i]);
    largest = std::isnan(d) ? INFINITY : std::max(largest, d);
  }
  return largest;
}

/// Largest distance (m) over time between corresponding particles.
inline double sup_distance(const Trajectory& a, const Trajectory& b, double until = INFINITY) {
  EXPECT_EQ(a.frames(), b.frames());
  double largest = 0;
  for (int i = 0; i < std::min(a.frames(), b.frames()) && a.t[i] <= until * (1 + 1e-9); ++i) {
    const double d = (a.x[i] - b.x[i]).colwise().norm().maxCoeff();
    largest = std::isnan(d) ? INFINITY : std::max(largest, d);
  }
  return largest;
}

/// Largest deviation (J) of the energy balance from its initial value.
inline double imbalance(const Stepper& s, const Scene& scene, const Run& run) {
  Ledger ledger(scene.model, ContactLoss::reported);
  simulate(s, ContactRule::coulomb, scene, run, ledger);
  double worst = 0;
  for (const LedgerRow& row : ledger.rows())
    worst = std::max(worst, std::abs(row.balance() - ledger.rows()[0].balance()));
  return worst;
}

inline bool identical(const Trajectory& a, const Trajectory& b) { return a.t == b.t && a.x == b.x && a.v == b.v; }

/// Succeeds if the text contains `part`; failures show the actual text.
inline ::testing::AssertionResult contains(const std::string& text, const std::string& part) {
  if (text.find(part) != std::string::npos) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "'" << part << "' is not in '" << text << "'";
}
inline ::testing::AssertionResult begins(const std::string& text, const std::string& part) {
  if (text.starts_with(part)) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "'" << text << "' does not begin with '" << part << "'";
}

/// Succeeds if the sentence contains these numbers, names and key words in this order, with any words in between.
inline ::testing::AssertionResult says(const std::string& sentence, std::initializer_list<std::string_view> parts) {
  size_t at = 0;
  for (const std::string_view part : parts) {
    const size_t found = sentence.find(part, at);
    if (found == std::string::npos) return ::testing::AssertionFailure() << "no '" << part << "' in: " << sentence;
    at = found + part.size();
  }
  return ::testing::AssertionSuccess();
}

/// Order of convergence, computed from the errors at a step and at half that step.
inline double slope(double coarse, double fine) { return std::log2(coarse / fine); }

/// Message of the InputError that f throws, or "".
template <class F>
std::string refusal_of(F f) {
  try {
    f();
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

/// First step at which a run that is not stopped is more than ten times as fast as `speed`. Speeds are central
/// differences.
inline long step_of_leaving(const Scene& scene, const crosscheck::Run& run, const char* rule, double speed) {
  struct Free : Observer {
    explicit Free(double fastest) : most(fastest) {}
    bool every_step() const override { return true; }
    Verdict observe(const State& s, bool) override {
      ++step;
      if (left == 0 && step >= 2 && largest_column(s.x - before.x) / (s.t - before.t) > most) left = step;
      before = std::exchange(last, s);
      return Verdict::ok;
    }
    double most;
    State before, last;
    long step = -1, left = 0;
  } free(10 * speed);
  simulate(stepper(rule), ContactRule::coulomb, scene, run, free);
  return free.left;
}

}  // namespace crosscheck::testing_tools
