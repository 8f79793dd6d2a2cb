// Reads nets, takes steps and lets a chain come to rest, for the calls of several parts.
#pragma once

#include <cmath>
#include <utility>

#include "calls.h"
#include "numbers.h"
#include "solvers.h"

namespace coursework {

/// n, mass, stiffness, gravity (3), number of springs, a, b, rest of each, held (n; 0 or 1).
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

inline State read_state(Reader& in, const Net& net) {
  State state;
  state.x = in.vectors<Vec3>(net.held.size());
  state.v = in.vectors<Vec3>(net.held.size());
  return state;
}

/// Calls the student's function, which may read x but not change it, and which must answer for all particles.
template <class Function>
std::vector<Vec3> of_all(const std::vector<Vec3>& x, const Function& function) {
  const std::vector<Vec3> given = x;
  std::vector<Vec3> got = function();
  for (std::size_t i = 0; i < x.size(); ++i)
    if (length(x[i] - given[i]) > 0) throw Unusable("state_kept");
  if (got.size() != x.size()) throw Unusable("particles", {got.size(), x.size()});
  return got;
}

/// step(state) is the student's.
template <class Step>
void advance(State& state, const char* function, const Step& step) {
  calling(function);
  State next;
  next.x = of_all(state.x, [&] { return (next = step(std::as_const(state))).x; });
  next.v = of_all(state.x, [&] { return next.v; });
  state = std::move(next);
}

inline void put(Numbers& out, const State& state) {
  for (std::size_t i = 0; i < state.x.size(); ++i) put(out, state.x[i]), put(out, state.v[i]);
}

/// A chain of so many particles that hang below a held one: mass, stiffness, rest, gravity.
struct Chain {
  Net net;
  double exact;  // its stretch at rest, m

  Chain(Reader& in) : net{}, exact(0) {
    const int n = in.integer();
    net.mass = in.number(), net.stiffness = in.number();
    const double rest = in.number(), g = in.number();
    net.gravity = {0, -g, 0};
    net.held.assign(static_cast<std::size_t>(n) + 1, false), net.held[0] = true;
    for (int i = 1; i <= n; ++i) net.springs.push_back({i - 1, i, rest});
    exact = net.mass * g / net.stiffness * n * (n + 1) / 2;
  }
  /// By how much it is stretched after so many steps, in percent of `exact`.
  template <class Step>
  double stretched(int steps, const char* function, const Step& step) const {
    State state;
    const double rest = net.springs[0].rest;
    for (std::size_t i = 0; i < net.held.size(); ++i) state.x.push_back({0, -rest * static_cast<double>(i), 0});
    state.v.resize(state.x.size());
    const double flat = state.x.back().y;
    for (int k = 0; k < steps; ++k) advance(state, function, step);
    return 100 * (flat - state.x.back().y) / exact;
  }
};

}  // namespace coursework
