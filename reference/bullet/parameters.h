// Conversion between parameters of a scene and of Bullet's worlds. Includes no header of Bullet, so that translation
// and measurement use the same formulas as the worlds.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <string>

#include "mysim/terms/springs.h"

namespace crosscheck::bullet {

/// Reduced mass 1 / (1/m_a + 1/m_b) of the two ends, with infinite mass for pins (kg); infinite between two pins.
inline double pair_mass(const Particles& particles, const Spring& spring) {
  const double inverse = (particles.pinned[spring.a] ? 0 : 1 / particles.mass[spring.a]) +
                         (particles.pinned[spring.b] ? 0 : 1 / particles.mass[spring.b]);
  return inverse > 0 ? 1 / inverse : std::numeric_limits<double>::infinity();
}

// Position-based links: each relaxation removes the share kLST of a link's extension. After a free step of length h, n
// relaxations leave (1 - kLST)^n of the extension, and backward Euler with a spring k would leave 1 / (1 + k h^2 / mu).
// The conversion equates the two.

/// kLST (dimensionless) of a link with stiffness k (N/m) between particles of reduced mass mu (kg), relaxed n times in
/// a step h (s); 1 between two pins.
inline double link_stiffness(double k, double mu, double h, int n) {
  return std::isinf(mu) ? 1 : -std::expm1(-std::log1p(k * h * h / mu) / n);
}
/// Stiffness (N/m) of a link: the inverse of link_stiffness().
inline double newton_per_metre(double kLST, double mu, double h, int n) {
  return mu / (h * h) * std::expm1(-n * std::log1p(-kLST));
}
/// d ln k / d ln kLST, by which a relative error of kLST is amplified.
inline double link_condition(double kLST, int n) {
  const double log_left = n * std::log1p(-kLST);  // logarithm of (1 - kLST)^n
  return n * kLST / (1 - kLST) / -std::expm1(log_left);
}
inline std::string link_stiffness_text(int n) { return fmt::format("kLST = 1 - (1 + k h^2 / mu)^(-1/{})", n); }

/// Converts a drag rate gamma (1/s) to kDP (dimensionless), the share by which a step of the position-based world
/// reduces all velocities; and back.
inline double damping_of_drag(double gamma, double h) { return -std::expm1(-gamma * h); }
inline double drag_of_damping(double kDP, double h) { return -std::log1p(-kDP) / h; }
/// d ln gamma / d ln kDP, by which a relative error of kDP is amplified.
inline double damping_condition(double kDP) { return kDP > 0 ? kDP / (1 - kDP) / -std::log1p(-kDP) : 1; }

// The explicit deformable world computes v' = (v + h f / m) (1 - h gamma). Drag as a force at v_n would not reduce the
// contribution of f, so the forces are divided by (1 - h gamma) before they are passed to Bullet.

/// Converts a drag rate gamma (1/s) to the body's drag factor (dimensionless), and back.
inline double drag_factor(double gamma, double h) { return h * gamma; }
inline double drag_of_factor(double factor, double h) { return factor / h; }
/// The stiffness or acceleration to pass to Bullet, so that `value` remains after the drag factor has acted.
inline double before_drag(double value, double factor) { return value / (1 - factor); }

}  // namespace crosscheck::bullet
