// The yardstick of speed: a plain loop over a scene's springs and particles that nobody makes faster.
#pragma once

#include <vector>

#include "mysim/scene.h"

namespace crosscheck {

/// Symplectic Euler with springs and gravity on plain arrays, one number after the other; what else a scene has it
/// leaves out. It uses nothing of any engine, so that a change to one of them cannot change it.
class PlainLoop {
 public:
  /// Stored speeds name it; whoever changes the loop changes this, and stored speeds are no longer compared.
  static constexpr const char* name = "plain loop 1";

  explicit PlainLoop(const Scene& scene);
  /// CPU time of so many steps from the scene's start, s. They are so short that no scene blows up: what a step costs
  /// does not depend on its length, but sums of nan cost something else.
  double seconds_of(long steps);
  /// Where it is, three numbers for each particle, m.
  const std::vector<double>& places() const { return x_; }
  double step() const { return h_; }  // s

 private:
  struct Edge {
    int a, b;
    double stiffness, rest;  // N/m, m
  };
  void advance(long steps);

  std::vector<Edge> edges_;
  std::vector<double> start_x_, start_v_, x_, v_, force_;  // three for each particle
  std::vector<double> per_mass_, falls_;                   // 1/kg, and 1; 0 where pinned
  double gravity_[3] = {0, 0, 0};                          // m/s^2
  double h_;                                               // s
};

}  // namespace crosscheck
