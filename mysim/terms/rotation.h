// Rotation about the z axis, the assignment's simple system: x' = rate (-y, x, 0). First order: no mass, no force.
#pragma once

#include <string_view>

#include "mysim/particles.h"

namespace crosscheck {

struct Rotation {
  static constexpr std::string_view name = "rotation";
  double rate;  // rad/s
};

/// rate: 3 x n, m/s.
inline void add_velocity(const Rotation& rotation, const State& state, Points& rate) {
  for (int i = 0; i < state.x.cols(); ++i) {
    rate(0, i) -= rotation.rate * state.x(1, i);
    rate(1, i) += rotation.rate * state.x(0, i);
  }
}

}  // namespace crosscheck
