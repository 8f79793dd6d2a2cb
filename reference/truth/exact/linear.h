// Linear equations of motion, split into modes: free and driven oscillators.
#pragma once

#include <Eigen/Core>

#include <cmath>
#include <optional>
#include <vector>

#include "mysim/particles.h"
#include "mysim/scene/scene.h"

namespace crosscheck {

// The damped harmonic oscillator u'' = -w2 u - gamma u', in its three regimes.

struct Oscillator {
  double omega2;  // k / m, 1/s^2
  double gamma;   // c / m, 1/s
  double u0;      // m
  double v0;      // m/s

  double position(double t) const {
    const auto [c, s] = parts(t);
    return u0 * c + (v0 + gamma / 2 * u0) * s;
  }
  double velocity(double t) const {
    const auto [c, s] = parts(t);
    // derivative of the above: without the decay, c' = (gamma^2/4 - w2) s and s' = c in all regimes
    return v0 * c - (omega2 * u0 + gamma / 2 * v0) * s;
  }
  /// Bound of |u| for all times, from the initial energy.
  double amplitude_bound() const { return std::sqrt(u0 * u0 + v0 * v0 / omega2); }

 private:
  struct Parts {
    double c, s;  // e^(-gamma t / 2) times cos(w t) and sin(w t) / w, or cosh and sinh / w, or 1 and t
  };
  Parts parts(double t) const {
    const double d = omega2 - gamma * gamma / 4, w = std::sqrt(std::abs(d)), decay = std::exp(-gamma / 2 * t);
    if (d > 0) return {decay * std::cos(w * t), decay * std::sin(w * t) / w};
    if (d == 0) return {decay, decay * t};
    // slow exponent gamma/2 - w without cancellation: exp times cosh would be 0 times infinity
    const double slow = std::exp(-omega2 / (gamma / 2 + w) * t);
    return {slow * (1 + std::exp(-2 * w * t)) / 2, slow * -std::expm1(-2 * w * t) / (2 * w)};
  }
};

/// u'' = -w2 (u - d) - drag u' - dashpot (u' - d') from rest at u = 0, where d = a r(t) sin(W t) is a prescribed motion
/// (mysim/particles.h) along a line. d is the imaginary part of a r(t) e^(iWt), and r is a polynomial of degree 5
/// during the ramp:
///   - during the ramp u, u' and the six functions t^j e^(iWt) satisfy a linear system with constant coefficients. Its
///     matrix exponential gives u, and remains finite at resonance, unlike undetermined coefficients;
///   - afterwards u = Im(Z e^(iWt)) with Z = a (w2 + iW dashpot) / (w2 - W^2 + iW (drag + dashpot)), plus a free motion
///     that matches the ramp's end. Z is infinite only at the resonance of an undamped oscillator.
class DrivenMotion {
 public:
  DrivenMotion(double omega2, double drag, double dashpot, double amplitude, const Motion& motion);

  double position(double t) const;  // s -> m
  double velocity(double t) const;  // s -> m/s
  /// Bound of |u| (m) for all times: rigorous, but at low frequencies perhaps some tens of percent too large. Infinite
  /// at resonance.
  double amplitude_bound() const;

 private:
  Eigen::Vector2d during_ramp(double t) const;                  // u (m), u' (m/s)
  Eigen::Vector2d steady_state(double t) const;                 // the motion with Z
  Eigen::Matrix<std::complex<double>, 8, 8> generator() const;  // 1/s, of (u, u'/w, s^j e^(iWt)), s = t / ramp

  double omega2_, drag_, dashpot_, amplitude_, omega_, ramp_;
  std::complex<double> z_;  // m
  Oscillator after_ramp_;   // starts at the ramp's end
};

/// u'' = -omega2 (u - participation d) - drag u' - dashpot (u' - participation d') + forcing, with the displacement
/// d(t) of moved pins along the line. The particles move by u(t) times the shape.
struct Mode {
  double omega2;         // 1/s^2; 0 without springs
  double drag;           // 1/s
  double dashpot;        // 1/s
  double forcing;        // m/s^2, gravity and steady wind
  double participation;  // 1
  double u0, v0;         // m, m/s, initial
  Points shape;          // 3 x n, largest entry about 1; 0 at pins
};

struct LinearScene {
  Points rest;  // 3 x n, m: positions at u = 0, the equilibrium under the springs alone; without springs, the start
  std::vector<Mode> modes;
  double base_amplitude = 0;  // m, amplitude of d; 0: fixed pins

  /// Smallest length of a spring if each mode reaches `amplitude` (m) on either side of `centre` (m), and moved pins
  /// reach `base_amplitude`. If this length is not positive, a spring may turn over, and the scene is not linear.
  /// Infinite without springs.
  double shortest_spring_length(const Model& model, const std::vector<double>& centre,
                                const std::vector<double>& amplitude) const;
};

/// Modes of the scene, or nullopt if it is neither of these:
///   - one free particle under gravity, steady wind and drag: three modes;
///   - Hooke's springs and masses on a line, with at least one of them pinned; gravity, steady wind, velocities and the
///     motion of the pins along the line; one drag rate; and dashpots in proportion to the stiffness (always so with
///     one free mass).
/// The caller must check that no spring turns over.
std::optional<LinearScene> linear_scene(const Scene& scene);

}  // namespace crosscheck
