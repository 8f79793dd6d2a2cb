// An additional term, as a contributor would write it, for new_term_slow_test.cpp. The compiler includes it first (g++
// -include), which adds it to the list of terms without any change to the source.
#pragma once

#include "mysim/forces.h"
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

/// A pull towards the origin. Defines a force and an energy, which is all that mysim's own steppers need.
struct Tide {
  static constexpr std::string_view name = "tide";
  double stiffness;  // N/m
};
inline void add_force(const Tide& tide, const Particles&, const State& state, Forces& forces) {
  forces.f -= tide.stiffness * state.x;
}
inline double potential_energy(const Tide& tide, const Particles&, const State& state) {
  return tide.stiffness / 2 * state.x.squaredNorm();
}

}  // namespace crosscheck

#define Planes Planes, Tide
#include "mysim/model/model.h"
#undef Planes

static_assert(std::is_same_v<std::variant_alternative_t<std::variant_size_v<crosscheck::Term> - 1, crosscheck::Term>,
                             crosscheck::Tide>);
