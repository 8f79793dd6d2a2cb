// The plain edge loop: the definition of the spring term, and the oracle of every faster kernel.
#include "mysim/terms/springs.h"

namespace crosscheck {

std::string_view name_of(Family family) {
  switch (family) {
    case Family::single:
      return "single";
    case Family::structural:
      return "structural";
    case Family::shear:
      return "shear";
    case Family::bend:
      return "bend";
  }
  return "unknown";
}

void add_force(const Springs& springs, const Particles&, const State& state, Forces& forces) {
  for (const Spring& s : springs.list) {
    const Vec3 d = state.x.col(s.a) - state.x.col(s.b);
    const double length = d.norm();
    if (length == 0) {
      // the ends met: no direction, no force, but the run says how often it happened
      forces.coincident += s.rest > 0;
      continue;
    }
    const Vec3 f = (-s.k * (length - s.rest) / length) * d;
    forces.f.col(s.a) += f;
    forces.f.col(s.b) -= f;
  }
}

double potential_energy(const Springs& springs, const Particles&, const State& state) {
  double energy = 0;
  for (const Spring& s : springs.list) {
    const double stretch = (state.x.col(s.a) - state.x.col(s.b)).norm() - s.rest;
    energy += 0.5 * s.k * stretch * stretch;
  }
  return energy;
}

}  // namespace crosscheck
