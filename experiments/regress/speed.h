// The speed of methods, as ratios to a plain loop on the same scene in the same rounds; and the file of blessed speeds.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiments/regress/cases.h"
#include "experiments/regress/strict_csv.h"
#include "mysim/scene/scene.h"

namespace crosscheck {

// The reference loop for speed: a plain loop over a scene's springs and particles that is never optimised.

/// Symplectic Euler with springs and gravity on plain arrays, one number after the other; what else a scene has it
/// leaves out. It uses nothing of any engine, so that a change to one of them cannot change it.
class PlainLoop {
 public:
  /// Stored speeds name it; it changes with the loop, and stored speeds are no longer compared.
  static constexpr const char* name = "plain loop 1";

  explicit PlainLoop(const Scene& scene);
  /// CPU time of so many steps from the scene's start, s. They are so short that no scene blows up: what a step costs
  /// does not depend on its length, but sums of nan cost something else.
  double seconds_of(long steps);
  /// Three numbers for each particle, m.
  const std::vector<double>& positions() const { return x_; }
  double step() const { return h_; }  // s

 private:
  struct Edge {
    int a, b;
    double stiffness, rest;  // N/m, m
  };
  void advance(long steps);

  std::vector<Edge> edges_;
  std::vector<double> start_x_, start_v_, x_, v_, force_;  // three for each particle
  std::vector<double> inverse_mass_, gravity_factor_;      // 1/kg; 1, or 0 where pinned
  double gravity_[3] = {0, 0, 0};                          // m/s^2
  double h_;                                               // s
};

/// One scene under one method, over its first steps; against another method where one is named.
struct SpeedCase {
  Scene scene;
  Method method;
  std::optional<Method> against = {};
  Run run = {};
  std::string in_words() const;
};

/// Every selected scene under its own method, and, where that is all of the shipped ones, a cloth of 32 x 32 particles
/// under every selected method (all of mysim and Bullet): what the filter leaves of them. With `against`, those scenes
/// under the one method that is selected. Programs of their own are left out: each has a clock of its own. Empty
/// where nothing is left.
std::vector<SpeedCase> speed_cases(const Selection& selection, const std::optional<Method>& against);

/// CPU time of a method over that of as many steps of the plain loop, 1, of every round; empty where the run is refused
/// or fails.
struct Ratios {
  std::vector<double> is;   // of the method
  std::vector<double> was;  // of the one that it is compared with, in the same rounds; empty without one
};

/// The source of measurements: so many rounds, each of which runs every case once. measured_ratios(), or a table of
/// invented ones.
using MeasureSpeeds = std::function<std::vector<Ratios>(const std::vector<SpeedCase>&, int rounds)>;

/// In each round each case is run between two runs of the plain loop, so that a slow spell of the machine falls
/// on both, and with everything elsewhere in memory, as drawn from the seed: that effect is noise, too.
std::vector<Ratios> measured_ratios(const std::vector<SpeedCase>& cases, int rounds, int seed);

}  // namespace crosscheck
