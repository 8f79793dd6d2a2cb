// Wind pressure on triangles.
#pragma once

#include <array>
#include <vector>

#include "mysim/terms/wind.h"

namespace crosscheck {

/// With u = wind velocity - mean velocity of the three corners, and A = area times unit normal, the force on the
/// triangle is 1/2 rho C |u| (u . A) A / |A|, a third of it on each corner: the pressure on a flat plate, proportional
/// to |u|^2 and to the sine of the angle between plate and air. It has no potential energy; its work counts as work of
/// the wind.
struct Aerodynamics {
  static constexpr std::string_view name = "aerodynamics";
  static constexpr bool uses_velocity = true;
  double density;       // rho of the air, kg/m^3
  double coefficient;   // C, dimensionless: normal-force coefficient divided by the sine, 1 to 2 for a flat plate
  WindSignal velocity;  // air velocity, m/s
  std::vector<std::array<int, 3>> triangles;
};

void add_force(const Aerodynamics& air, const Particles& particles, const State& state, Forces& forces);

}  // namespace crosscheck
