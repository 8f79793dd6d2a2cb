// The numbers that Bullet's worlds take in place of a scene's, and back: each formula stands here, once. No header of
// Bullet's: whoever translates or measures uses the same functions as the worlds.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <string>

#include "mysim/terms/springs.h"

namespace crosscheck::bullet {

/// mu of the pair of ends, 1 / (1/m_a + 1/m_b) with pins of infinite mass, kg; infinite between two pins.
inline double pair_mass(const Particles& particles, const Spring& spring) {
  const double inverse = (particles.pinned[spring.a] ? 0 : 1 / particles.mass[spring.a]) +
                         (particles.pinned[spring.b] ? 0 : 1 / particles.mass[spring.b]);
  return inverse > 0 ? 1 / inverse : std::numeric_limits<double>::infinity();
}

// Position-based links: every relaxation removes the share kLST of a link's extension, so that n of them leave
// (1 - kLST)^n of what a free step of length h made of it. Backward Euler on a spring k leaves 1 / (1 + k h^2 / mu).

/// kLST (1) of a link of stiffness k (N/m) between particles of reduced mass mu (kg), relaxed n times in a step h (s);
/// 1 between two pins.
inline double link_stiffness(double k, double mu, double h, int n) {
  return std::isinf(mu) ? 1 : -std::expm1(-std::log1p(k * h * h / mu) / n);
}
/// The stiffness (N/m) that kLST stands for: the inverse of link_stiffness.
inline double newton_per_metre(double kLST, double mu, double h, int n) {
  return mu / (h * h) * std::expm1(-n * std::log1p(-kLST));
}
/// d ln k / d ln kLST: how many times larger a relative error of kLST is in the stiffness that it stands for.
inline double link_condition(double kLST, int n) {
  const double log_left = n * std::log1p(-kLST);  // of (1 - kLST)^n
  return n * kLST / (1 - kLST) / -std::expm1(log_left);
}
inline std::string link_stiffness_text(int n) { return fmt::format("kLST = 1 - (1 + k h^2 / mu)^(-1/{})", n); }

/// kDP (1) of the position-based world, the share of all velocities that a step takes, of a drag rate gamma (1/s); and
/// back.
inline double damping_of_drag(double gamma, double h) { return -std::expm1(-gamma * h); }
inline double drag_of_damping(double kDP, double h) { return -std::log1p(-kDP) / h; }
/// d ln gamma / d ln kDP: how many times larger a relative error of kDP is in the drag rate that it stands for.
inline double damping_condition(double kDP) { return kDP > 0 ? kDP / (1 - kDP) / -std::log1p(-kDP) : 1; }

// The explicit deformable world: v' = (v + h f / m) (1 - h gamma), where a drag as a force at v_n would leave the share
// of the forces whole. They are handed over divided by what the drag factor leaves.

/// The body's drag factor (1) of a drag rate gamma (1/s), and back.
inline double drag_factor(double gamma, double h) { return h * gamma; }
inline double drag_of_factor(double factor, double h) { return factor / h; }
/// A stiffness or an acceleration before that factor takes its share of it.
inline double before_drag(double value, double factor) { return value / (1 - factor); }

}  // namespace crosscheck::bullet
