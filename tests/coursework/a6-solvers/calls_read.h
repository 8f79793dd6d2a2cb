// Readers of nets, and checked calls of the student's functions, shared by several parts.
#pragma once

#include "solvers.h"
#include "states.h"

namespace coursework {

/// Reads n, mass, stiffness, gravity (3), number of springs, `a`, `b`, `rest` of each spring, held (n; 0 or 1).
inline Net read_net(Reader& in) {
  const std::size_t n = in.count();
  Net net;
  net.mass = in.number(), net.stiffness = in.number(), net.gravity = in.vector<Vec3>();
  for (std::size_t left = in.count(); left > 0; --left) {
    const int a = in.integer(), b = in.integer();
    net.springs.push_back({a, b, in.number()});
  }
  for (std::size_t i = 0; i < n; ++i) net.held.push_back(in.number() != 0);
  return net;
}

/// Calls the student's function. It must not change `x`, and must return a vector for every particle.
template <class Function>
std::vector<Vec3> of_all(const std::vector<Vec3>& x, const Function& function) {
  const std::vector<Vec3> given = x;
  std::vector<Vec3> got = function();
  for (std::size_t i = 0; i < x.size(); ++i)
    if (length(x[i] - given[i]) > 0) throw Unusable("state_kept");
  if (got.size() != x.size()) throw Unusable("particles", {got.size(), x.size()});
  return got;
}

/// Stretch of a chain after `steps` steps, in percent of the exact stretch at rest.
template <class Step>
double stretch_at_rest(const Net& chain, int steps, const char* function, const Step& step) {
  State state = straight_state(chain);
  const double length = -state.x.back().y, n = static_cast<double>(chain.springs.size());
  for (int k = 0; k < steps; ++k) advance(state, function, step);
  return 100 * (-state.x.back().y - length) * chain.stiffness / (-chain.mass * chain.gravity.y * n * (n + 1) / 2);
}

/// Reads the number of particles that hang, mass, stiffness, rest length, gravity.
inline Net read_chain(Reader& in) {
  const int n = in.integer();
  const double mass = in.number(), stiffness = in.number(), rest = in.number();
  return hanging_chain(n, mass, stiffness, rest, {0, -in.number(), 0});
}

}  // namespace coursework
