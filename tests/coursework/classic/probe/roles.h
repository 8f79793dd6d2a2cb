// What is asked of a student's system in each of its roles. Whatever the class is called: the parts' calls name it.
#pragma once

#include <type_traits>

#include "ask.h"

namespace probe {

/// "field": in the vector that is given, then the one that is stored; out the derivative.
template <class T>
bool simple(const std::string& call, const coursework::Numbers& in, coursework::Numbers& out) {
  if (call != "field") return false;
  T& system = ready<T>(1, false);
  const auto vector = [&](std::size_t i) {
    return Vector3f(static_cast<float>(in[i]), static_cast<float>(in[i + 1]), static_cast<float>(in[i + 2]));
  };
  const std::size_t size = state_of(system).size();
  // further entries, where there are any, hold other numbers
  Vec given(size, vector(3)), stored(size, vector(0));
  given[0] = vector(0);
  stored[0] = vector(3);
  store(system, stored);
  const Vec f = evaluate(system, given);
  if (f.empty()) throw coursework::Unusable("evalf_empty");
  for (int k = 0; k < 3; ++k) out.push_back(f[0][k]);
  return true;
}

/// A call of forces.h with "pendulum." or "chain." before it; in the count of particles and the seed; out is what evalF
/// answered.
template <class Pendulum, class Chain>
bool pendulum(const std::string& call, const coursework::Numbers& in, coursework::Numbers& out) {
  const int count = static_cast<int>(in[0]);
  const auto seed = static_cast<std::uint64_t>(in[1]);
  // if the argument turns out to count the entries of the state, twice as many are asked for
  const std::size_t least = 2 * static_cast<std::size_t>(count);
  if (call.rfind("pendulum.", 0) == 0)
    return answered(ready<Pendulum>(count, true, least, 2 * count), seed, call.substr(9), out);
  if (call.rfind("chain.", 0) != 0) return false;
  if constexpr (std::is_same_v<Pendulum, Chain>) {
    // one of another size was asked before: nothing of it may be kept
    auto& other = ready<Pendulum>(2, true, 4, 4);
    evaluate(other, state_of(other));
  }
  return answered(ready<Chain>(count, true, least, 2 * count), seed, call.substr(6), out);
}

/// A call of forces.h with "cloth." before it; in the particles along a side and the seed; out is what evalF answered.
template <class T>
bool cloth(const std::string& call, const coursework::Numbers& in, coursework::Numbers& out) {
  if (call.rfind("cloth.", 0) != 0) return false;
  const int side = static_cast<int>(in[0]);
  // where the one argument turns out to be the count of all, so much is asked for instead
  T& system = ready<T>(side, false, 2 * side * side, side * side);
  return answered(system, static_cast<std::uint64_t>(in[1]), call.substr(6), out);
}

}  // namespace probe
