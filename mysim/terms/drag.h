// Linear viscous drag: force -c_i v_i on every particle.
#pragma once

#include <string_view>

#include "mysim/forces.h"
#include "mysim/particles.h"

namespace crosscheck {

/// A scene specifies c for all particles, or gamma (1/s), meaning c_i = gamma m_i, but not both.
struct Drag {
  static constexpr std::string_view name = "drag";
  Eigen::VectorXd c;  // n, N s/m
};

inline void add_force(const Drag& drag, const Particles&, const State& state, Forces& forces) {
  for (int i = 0; i < state.x.cols(); ++i) forces.f.col(i) -= drag.c[i] * state.v.col(i);
}

}  // namespace crosscheck
