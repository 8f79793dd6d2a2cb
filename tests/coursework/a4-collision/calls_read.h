// Reads what the calls of the collision assignment have in common.
#pragma once

#include "contact.h"
#include "numbers.h"

namespace coursework {

/// Centre (3), radius, margin, friction, restitution.
inline Sphere read_sphere(Reader& in) {
  Sphere sphere;
  sphere.centre = in.vector<Vec3>();
  for (double* one : {&sphere.radius, &sphere.margin, &sphere.friction, &sphere.restitution}) *one = in.number();
  return sphere;
}

/// Positions, then velocities.
inline State read_state(Reader& in, int count) {
  State state;
  state.x = in.vectors<Vec3>(count);
  state.v = in.vectors<Vec3>(count);
  return state;
}

/// Position and velocity of each particle.
inline void put(Numbers& out, const State& state) {
  for (std::size_t i = 0; i < state.x.size(); ++i) {
    put(out, state.x[i]);
    put(out, state.v.at(i));
  }
}

}  // namespace coursework
