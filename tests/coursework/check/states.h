// States of particles in the calls of an assignment whose State has two vectors, x and v.
#pragma once

#include <utility>

#include "calls.h"
#include "numbers.h"

namespace coursework {

/// Reads positions, then velocities.
template <class State>
State read_state(Reader& in, std::size_t count) {
  using V = typename decltype(State::x)::value_type;
  State state;
  state.x = in.vectors<V>(count);
  state.v = in.vectors<V>(count);
  return state;
}

template <class State>
void put_state(Numbers& out, const State& state) {
  for (std::size_t i = 0; i < state.x.size(); ++i) put(out, state.x[i]), put(out, state.v.at(i));
}

/// Performs a step with the student's code, which must not change the given state.
template <class State, class Step>
void advance(State& state, const char* function, const Step& step) {
  const State given = state;
  calling(function);
  State next = step(std::as_const(state));
  const auto same = [](const auto& a, const auto& b) {
    bool all = a.size() == b.size();
    for (std::size_t i = 0; all && i < a.size(); ++i) all = a[i].x == b[i].x && a[i].y == b[i].y && a[i].z == b[i].z;
    return all;
  };
  if (!same(given.x, state.x) || !same(given.v, state.v)) throw Unusable("state_kept");
  state = std::move(next);
  if (state.x.size() != given.x.size() || state.v.size() != given.x.size())
    throw Unusable("particles", {state.x.size(), given.x.size()});
}

}  // namespace coursework
