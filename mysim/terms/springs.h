// Linear springs. With d = x_a - x_b and L = |d|: force on a is -k (L - r) d / L, on b the opposite; energy k (L - r)^2
// / 2.
#pragma once

#include <string_view>
#include <vector>

#include "mysim/forces.h"
#include "mysim/particles.h"

namespace crosscheck {

enum class Family { single, structural, shear, bend };
std::string_view name_of(Family family);

struct Spring {
  int a, b;       // ends
  double k;       // stiffness, N/m
  double rest;    // rest length r, m
  Family family;  // for colours, tables and the model ladder; physics does not look at it
};

struct Springs {
  static constexpr std::string_view name = "springs";
  std::vector<Spring> list;
};

void add_force(const Springs& springs, const Particles& particles, const State& state, Forces& forces);
double potential_energy(const Springs& springs, const Particles& particles, const State& state);  // J

}  // namespace crosscheck
