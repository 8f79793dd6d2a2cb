#include "mysim/terms/springs.h"

#include <algorithm>
#include <cmath>

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

std::string_view name_of(SpringLaw law) { return law == SpringLaw::hooke ? "hooke" : "bullet-link"; }

Tension tension_of(const Spring& s, SpringLaw law, double length) {
  if (law == SpringLaw::hooke) return {s.k * (length - s.rest), s.k};
  const double l2 = length * length, r2 = s.rest * s.rest, sum = l2 + r2;
  return {s.k * length * (l2 - r2) / sum, s.k * (l2 * l2 + 4 * l2 * r2 - r2 * r2) / (sum * sum)};
}

void add_force(const Springs& springs, const Particles&, const State& state, Forces& forces) {
  add_force(springs, state.x, forces);
}

/// One loop per law, to avoid a branch for each spring.
template <SpringLaw law>
static void loop(const std::vector<Spring>& list, const Points& x, Forces& forces) {
  for (const Spring& s : list) {
    const Vec3 d = x.col(s.a) - x.col(s.b);
    const double squared = d.squaredNorm();
    if (squared == 0) {
      // coincident ends have no direction and no force, but are counted
      forces.degenerate_springs += s.rest > 0;
      continue;
    }
    const Vec3 f = force_over_length<law>(s.k, s.rest, squared) * d;
    forces.f.col(s.a) += f;
    forces.f.col(s.b) -= f;
  }
}

void add_force(const Springs& springs, const Points& x, Forces& forces) {
  if (springs.law == SpringLaw::hooke)
    loop<SpringLaw::hooke>(springs.list, x, forces);
  else
    loop<SpringLaw::bullet_link>(springs.list, x, forces);
}

double potential_energy(const Springs& springs, const Particles&, const State& state) {
  double energy = 0;
  for (const Spring& s : springs.list) {
    const double length = (state.x.col(s.a) - state.x.col(s.b)).norm();
    if (springs.law == SpringLaw::hooke) {
      energy += 0.5 * s.k * (length - s.rest) * (length - s.rest);
    } else {
      // log1p keeps the digits near the rest length, where both parts nearly cancel; rounding may leave a negative
      // remainder
      const double r2 = s.rest * s.rest, excess = length * length - r2;
      energy += 0.5 * s.k * std::max(0.0, r2 > 0 ? excess - 2 * r2 * std::log1p(excess / (2 * r2)) : excess);
    }
  }
  return energy;
}

void add_tangent(const Springs& springs, const Particles&, const State& state, Curvature curvature, Tangent& tangent) {
  for (const Spring& s : springs.list) {
    const Vec3 d = state.x.col(s.a) - state.x.col(s.b);
    const double length = d.norm();
    if (length == 0) continue;  // coincident ends have no direction, no force and no stiffness
    const auto [force, slope] = tension_of(s, springs.law, length);
    double along = slope, across = force / length;
    if (curvature == Curvature::clamped) along = std::max(0.0, along), across = std::max(0.0, across);
    tangent.add_stiffness({s.a, s.b, d / length, along, across});
  }
}

}  // namespace crosscheck
