// The constant part of a scene: particles and the terms that act on them. The variant below is the table of terms: a
// new term is a file in terms/, one line here, and one line in the reader's table (mysim/scene/scene.cpp).
//
// The functions that a term's file declares, found by overload resolution, define what the term does:
//   add_force(term, particles, state, forces)         a force
//   potential_energy(term, particles, state)          an energy whose negative gradient is that force
//   add_tangent(term, particles, state, curvature, tangent)   derivatives of that force, for implicit methods
//   add_velocity(term, state, rate)                   a first-order velocity field
// Terms with forces that depend on velocity (dashpots, air) also declare `uses_velocity`: leapfrog treats them
// separately, which preserves its order. Spheres, planes and constraints are not forces: contact acts on whole steps,
// and constraints are enforced by methods.
//
// Code that must handle every term (energies, hash, JSON, certificate, each engine) visits the variant with one
// function per term and no generic fallback: a new term does not compile there until it is handled
// (new_term_slow_test.cpp).
#pragma once

#include <concepts>
#include <variant>
#include <vector>

#include "mysim/particles.h"
#include "mysim/terms/aerodynamics.h"
#include "mysim/terms/bending.h"
#include "mysim/terms/constraints.h"
#include "mysim/terms/dashpots.h"
#include "mysim/terms/drag.h"
#include "mysim/terms/gravity.h"
#include "mysim/terms/rotation.h"
#include "mysim/terms/springs.h"
#include "mysim/terms/surface.h"
#include "mysim/terms/wind.h"

namespace crosscheck {

using Term =
    std::variant<Rotation, Gravity, Springs, Bending, Dashpots, Constraints, Drag, Wind, Aerodynamics, Spheres, Planes>;

template <class... Functions>
struct Overloaded : Functions... {
  using Functions::operator()...;
};
template <class... Functions>
Overloaded(Functions...) -> Overloaded<Functions...>;  // clang deduces this itself from version 17 on
/// Terms that a visitor ignores, by name: [](const OneOf<Drag, Wind> auto&) {}.
template <class T, class... Terms>
concept OneOf = (std::same_as<T, Terms> || ...);

template <class T>
concept HasForce = requires(const T& term, const Particles& p, const State& s, Forces& f) {
  add_force(term, p, s, f);
};
template <class T>
concept HasPotential = requires(const T& term, const Particles& p, const State& s) {
  potential_energy(term, p, s);
};
template <class T>
concept HasTangent = requires(const T& term, const Particles& p, const State& s, Tangent& tangent) {
  add_tangent(term, p, s, Curvature::exact, tangent);
};
template <class T>
concept UsesVelocity = requires {
  requires T::uses_velocity;
};
template <class T>
concept HasVelocityField = requires(const T& term, const State& s, Points& rate) {
  add_velocity(term, s, rate);
};

struct Model {
  Particles particles;
  std::vector<Term> terms;

  template <class T>
  const T* find() const {
    for (const Term& term : terms)
      if (const T* found = std::get_if<T>(&term)) return found;
    return nullptr;
  }
  template <class T>
  T* find() {
    return const_cast<T*>(static_cast<const Model*>(this)->find<T>());
  }

  bool first_order() const { return find<Rotation>() != nullptr; }
};

bool has_contact(const Model& model);
/// Surfaces in the order in which they act: spheres, then planes.
std::vector<Surface> surfaces_of(const Model& model);
bool has_moving_surface(const Model& model);

inline std::string_view name_of(const Term& term) {
  return std::visit([](const auto& t) { return std::decay_t<decltype(t)>::name; }, term);
}

}  // namespace crosscheck
