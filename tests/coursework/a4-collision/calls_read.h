// Readers shared by the calls of the collision assignment.
#pragma once

#include <utility>

#include "calls.h"
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

/// Point (3), normal (3), margin, friction.
inline Plane read_plane(Reader& in) {
  Plane plane;
  plane.point = in.vector<Vec3>(), plane.normal = in.vector<Vec3>();
  plane.margin = in.number(), plane.friction = in.number();
  return plane;
}

/// Positions, then velocities.
inline State read_state(Reader& in, int count) {
  State state;
  state.x = in.vectors<Vec3>(count);
  state.v = in.vectors<Vec3>(count);
  return state;
}

/// Performs a step of the student's code, which may read the given state but not change it.
template <class Step>
void advance(State& state, const char* function, Step step) {
  const State given = state;
  calling(function);
  State next = step(state);
  const auto same = [](const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    bool all = a.size() == b.size();
    for (std::size_t i = 0; all && i < a.size(); ++i) all = a[i].x == b[i].x && a[i].y == b[i].y && a[i].z == b[i].z;
    return all;
  };
  if (!same(given.x, state.x) || !same(given.v, state.v)) throw Unusable("state_kept");
  state = std::move(next);
  if (state.x.size() != given.x.size() || state.v.size() != given.x.size())
    throw Unusable("particles", {state.x.size(), given.x.size()});
}

/// Position and velocity of each particle.
inline void put(Numbers& out, const State& state) {
  for (std::size_t i = 0; i < state.x.size(); ++i) {
    put(out, state.x[i]);
    put(out, state.v.at(i));
  }
}

}  // namespace coursework
