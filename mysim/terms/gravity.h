// Uniform gravity: force m g on every particle, potential energy -m g . x.
#pragma once

#include <string_view>

#include "mysim/forces.h"
#include "mysim/particles.h"

namespace crosscheck {

struct Gravity {
  static constexpr std::string_view name = "gravity";
  Vec3 acceleration;  // m/s^2
};

inline void add_force(const Gravity& gravity, const Particles& particles, const State&, Forces& forces) {
  for (int i = 0; i < particles.size(); ++i) forces.f.col(i) += particles.mass[i] * gravity.acceleration;
}

/// Energy (J) of the free particles, zero at the origin.
inline double potential_energy(const Gravity& gravity, const Particles& particles, const State& state) {
  double energy = 0;
  for (int i = 0; i < particles.size(); ++i)
    if (!particles.pinned[i]) energy -= particles.mass[i] * gravity.acceleration.dot(state.x.col(i));
  return energy;
}

}  // namespace crosscheck
