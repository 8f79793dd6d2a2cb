// Wraps a student's system of any constructor, constness and reference type. C++20, included after the student's
// header.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <new>
#include <type_traits>
#include <vector>

#include "../../check/calls.h"
#ifdef PARTICLE_SCOPE
using namespace PARTICLE_SCOPE;
#endif

namespace probe {

using Vec = std::vector<Vector3f>;

inline Vector3f vector_at(const coursework::Numbers& in, std::size_t i) {
  return Vector3f(static_cast<float>(in.at(i)), static_cast<float>(in.at(i + 1)), static_cast<float>(in.at(i + 2)));
}

/// Value for a constructor's argument of unknown meaning: integers get the count, floating-point numbers (lengths,
/// masses) 1, and switches are off.
struct Filler {
  int count;
  template <class T>
  requires std::is_arithmetic_v<T>
  operator T() const {
    if constexpr (std::is_same_v<T, bool>) return false;
    if constexpr (std::is_floating_point_v<T>) return 1;
    return static_cast<T>(count);
  }
  operator Vector3f() const { return Vector3f(0.0f, 0.0f, 0.0f); }
};

/// Value for an argument of evalF beyond the state (a time, a switch): zero.
struct Zero {
  template <class T>
  requires std::is_arithmetic_v<T>
  operator T() const { return T(); }
};

/// Discards the output of an evalF that prints, because the output of ten thousand calls would exceed the grader's
/// limit. The hand-out's check keeps the output, because its own report goes to the same streams, and because the
/// student may want to read the output.
inline void quiet() {
#ifdef OWN_PROCESS
  static bool done = false;
  if (done) return;
  done = true;
  std::cout.setstate(std::ios::badbit);
  std::cerr.setstate(std::ios::badbit);
  std::clog.setstate(std::ios::badbit);
  if (!std::freopen("/dev/null", "w", stdout)) std::fclose(stdout);
  if (!std::freopen("/dev/null", "w", stderr)) std::fclose(stderr);
#endif
}

/// Restarts rand() and similar generators, so that a random wind is the same in every evaluation.
inline void start_random_numbers() {
  std::srand(1);
#ifndef _WIN32  // Windows has no drand48
  srand48(1);
#endif
}

/// Zeroed memory with spare room behind it, so that an uninitialised flag is off on every run.
template <class T>
void* zeroed() {
  void* memory = std::calloc(1, sizeof(T) + 65536);
  if (!memory) throw std::bad_alloc();
  return memory;
}

/// `counted`: prefer the constructor that takes a count; otherwise the default constructor.
template <class T>
T* make(int count, bool counted) {
  quiet();
  static_assert(!std::is_abstract_v<T>,
                "the class is abstract: it lacks a virtual function that its base class requires");
  void* at = zeroed<T>();
  const Filler f{count};
  if constexpr (std::is_constructible_v<T, int>)
    if (counted || !std::is_default_constructible_v<T>) return new (at) T(count);
  if constexpr (std::is_default_constructible_v<T>)
    return new (at) T();
  else if constexpr (std::is_constructible_v<T, Filler>)
    return new (at) T(f);
  else if constexpr (std::is_constructible_v<T, Filler, Filler>)
    return new (at) T(f, f);
  else if constexpr (std::is_constructible_v<T, Filler, Filler, Filler>)
    return new (at) T(f, f, f);
  else if constexpr (std::is_constructible_v<T, Filler, Filler, Filler, Filler>)
    return new (at) T(f, f, f, f);
  else if constexpr (std::is_constructible_v<T, Filler, Filler, Filler, Filler, Filler>)
    return new (at) T(f, f, f, f, f);
  else if constexpr (!std::is_constructible_v<T, int>)
    static_assert(std::is_constructible_v<T>, "no constructor that can be called with a count, or without arguments");
  return nullptr;
}

/// The base class as a type that depends on the call, so that missing members can be tested without a compile error.
template <class T, class Base = ParticleSystem>
Base& base_of(T& system) {
  return system;
}

template <class T>
Vec state_of(T& system) {
  if constexpr (requires { Vec(system.getState()); })
    return Vec(system.getState());
  else
    return Vec(base_of(system).getState());
}

template <class T>
void store(T& system, Vec state) {
  if constexpr (requires { system.setState(state); })
    system.setState(state);
  else
    base_of(system).setState(state);
}

template <class T>
Vec evaluate(T& system, Vec state) {
  start_random_numbers();
  coursework::calling("evalF");
  if constexpr (requires { Vec(system.evalF(state)); })
    return Vec(system.evalF(state));
  else if constexpr (requires { Vec(system.evalF(state, Zero{})); })
    return Vec(system.evalF(state, Zero{}));
  else if constexpr (requires { Vec(system.evalF(state, Zero{}, Zero{})); })
    return Vec(system.evalF(state, Zero{}, Zero{}));
  else
    return Vec(base_of(system).evalF(state));
}

/// Some classes fill the state in a separate function.
template <class T>
void fill_state(T& system) {
  if constexpr (requires { Vec(system.initState()); })
    store(system, Vec(system.initState()));
  else if constexpr (requires { system.initState(); })
    system.initState();
  else if constexpr (requires { system.init(); })
    system.init();
  else if constexpr (requires { system.reset(); })
    system.reset();
}

/// A system constructed with `count`, whatever the constructor counts. If the state of that system has fewer than
/// `least` entries, constructs one with `other_count`, and returns the system with the longer state.
template <class T>
T& ready(int count, bool counted, std::size_t least = 1, int other_count = 0) {
  const auto made = [&](int of) {
    T* system = make<T>(of, counted);
    if (state_of(*system).empty()) fill_state(*system);
    return system;
  };
  T* system = made(count);
  if (state_of(*system).size() < least && (counted || !std::is_default_constructible_v<T>))
    if (T* other = made(other_count); state_of(*other).size() > state_of(*system).size()) system = other;
  if (state_of(*system).empty()) throw coursework::Unusable("state_empty");
  return *system;
}

}  // namespace probe
