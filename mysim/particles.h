// The constant part of the particles: masses, pins, and the prescribed motion of pins and spheres.
#pragma once

#include <optional>
#include <vector>

#include "mysim/types.h"

namespace crosscheck {

/// Prescribed motion of a sphere, or of all pins together. The displacement is d(t) = amplitude r(t) sin(2 pi frequency
/// t), where the ramp r rises from 0 to 1 during the first `ramp` seconds as 6 s^5 - 15 s^4 + 10 s^3 (twice
/// continuously differentiable).
struct Motion {
  Vec3 amplitude;    // m
  double frequency;  // Hz
  double ramp;       // s
};

/// Upper bound of |d'(t)| (m/s): |amplitude| (omega + 15/8 / ramp), where 15/8 is the ramp's steepest slope.
double max_speed(const Motion& motion);
Vec3 displacement_at(const Motion& motion, double t);  // m
Vec3 velocity_at(const Motion& motion, double t);      // m/s

struct Particles {
  Eigen::VectorXd mass;        // n, kg; energies ignore the masses of pinned particles
  std::vector<int> pins;       // pinned particles, ascending
  std::vector<char> pinned;    // n; 1 where pinned
  Points pin_home;             // 3 x pins, m: positions at t = 0
  std::optional<Motion> move;  // if absent, the pins are fixed

  int size() const { return static_cast<int>(mass.size()); }
  /// Sets the pins' positions and velocities at state.t.
  void place_pins(State& state) const;
  void place_pin_velocities(State& state) const;
};

}  // namespace crosscheck
