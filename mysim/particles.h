// The constant part of the particles: masses, which of them are pinned, and how the pins move.
#pragma once

#include <optional>
#include <vector>

#include "mysim/motion.h"

namespace crosscheck {

struct Particles {
  Eigen::VectorXd mass;        // n, kg; pinned particles have one too (energies leave it out)
  std::vector<int> pins;       // indices of the pinned particles, ascending
  std::vector<char> pinned;    // n; 1 where pinned
  Points pin_home;             // 3 x pins, m: where each pin is at t = 0
  std::optional<Motion> move;  // none: the pins stand still

  int size() const { return static_cast<int>(mass.size()); }
  /// Writes positions and velocities that the pins have at state.t.
  void place_pins(State& state) const;
  void place_pin_velocities(State& state) const;  // the second half of it
};

}  // namespace crosscheck
