// Energies and powers of a state by mysim's formulas, for every engine.
#pragma once

#include "mysim/model/model.h"

namespace crosscheck {

struct Energy {
  double kinetic = 0;        // J, of the free particles
  double elastic = 0;        // J, of springs and bending
  double gravitational = 0;  // J, of the free particles, zero at the origin
  double total() const { return kinetic + elastic + gravitational; }
};

struct Power {
  double drag = 0;      // W, dissipated by drag (not negative)
  double dashpots = 0;  // W, dissipated by dashpots (not negative)
  double wind = 0;      // W, supplied by the wind, uniform or on triangles
  double pins = 0;      // W, supplied by moved pins: sum of -f . v; springs, bending and dashpots exert f on a pin
  double dissipated() const { return drag + dashpots; }
};

Energy energy_of(const Model& model, const State& state);
/// `scratch`: working memory of the size of the state; saves an allocation per step.
Power power_of(const Model& model, const State& state, Forces& scratch);

}  // namespace crosscheck
