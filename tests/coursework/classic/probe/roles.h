// Calls of a student's system in each of its roles. Independent of the class name, which the parts' calls supply.
#pragma once

#include <type_traits>

#include "ask.h"

namespace probe {

/// "field". Input: the given vector, then the stored one. Output: the derivative.
template <class T>
bool simple(const std::string& call, const coursework::Numbers& in, coursework::Numbers& out) {
  if (call != "field") return false;
  T& system = ready<T>(1, false);
  const std::size_t size = state_of(system).size();
  // fills each vector with the first entry of the other, except for its own first entry: the two then differ everywhere
  Vec given(size, vector_at(in, 3)), stored(size, vector_at(in, 0));
  given[0] = vector_at(in, 0);
  stored[0] = vector_at(in, 3);
  store(system, stored);
  const Vec f = evaluate(system, given);
  if (f.empty()) throw coursework::Unusable("evalf_empty");
  for (int k = 0; k < 3; ++k) out.push_back(f[0][k]);
  return true;
}

/// Answers a call of forces.h with the prefix "pendulum." or "chain.". Input: number of particles and seed. Output: the
/// answers of evalF.
template <class Pendulum, class Chain>
bool pendulum(const std::string& call, const coursework::Numbers& in, coursework::Numbers& out) {
  const int count = static_cast<int>(in[0]);
  const auto seed = static_cast<std::uint64_t>(in[1]);
  // if the constructor's argument turns out to be the number of state entries, passes twice the count
  const std::size_t least = 2 * static_cast<std::size_t>(count);
  if (call.rfind("pendulum.", 0) == 0)
    return answered(ready<Pendulum>(count, true, least, 2 * count), seed, call.substr(9), out);
  if (call.rfind("chain.", 0) != 0) return false;
  if constexpr (std::is_same_v<Pendulum, Chain>) {
    // first uses a system of another size, which must not affect later systems
    auto& other = ready<Pendulum>(2, true, 4, 4);
    evaluate(other, state_of(other));
  }
  return answered(ready<Chain>(count, true, least, 2 * count), seed, call.substr(6), out);
}

/// Answers a call of forces.h with the prefix "cloth.". Input: number of particles along a side, and seed. Output: the
/// answers of evalF.
template <class T>
bool cloth(const std::string& call, const coursework::Numbers& in, coursework::Numbers& out) {
  if (call.rfind("cloth.", 0) != 0) return false;
  const int side = static_cast<int>(in[0]);
  // if the constructor's argument turns out to be the total number of particles, passes the total instead
  T& system = ready<T>(side, false, 2 * side * side, side * side);
  return answered(system, static_cast<std::uint64_t>(in[1]), call.substr(6), out);
}

}  // namespace probe
