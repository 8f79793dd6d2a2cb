// Scenes whose equations of motion are linear, split into modes, and the free and driven oscillators that these are.
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
    // d/dt of the above: without the decay, c' = (gamma^2/4 - w2) s and s' = c hold in all regimes
    return v0 * c - (omega2 * u0 + gamma / 2 * v0) * s;
  }
  /// A bound of |u| at all times, from the energy at the start.
  double amplitude_bound() const { return std::sqrt(u0 * u0 + v0 * v0 / omega2); }

 private:
  struct Parts {
    double c, s;  // e^(-gamma t / 2) times cos(w t) and sin(w t) / w, or cosh and sinh / w, or 1 and t
  };
  Parts parts(double t) const {
    const double d = omega2 - gamma * gamma / 4, w = std::sqrt(std::abs(d)), decay = std::exp(-gamma / 2 * t);
    if (d > 0) return {decay * std::cos(w * t), decay * std::sin(w * t) / w};
    if (d == 0) return {decay, decay * t};
    // by the slow exponent gamma/2 - w, written without its cancellation: exp and cosh apart would be 0 times infinity
    const double slow = std::exp(-omega2 / (gamma / 2 + w) * t);
    return {slow * (1 + std::exp(-2 * w * t)) / 2, slow * -std::expm1(-2 * w * t) / (2 * w)};
  }
};

// The driven part of an oscillator's motion.

/// u'' = -w2 (u - d) - drag u' - dashpot (u' - d') from rest at u = 0, where d = a r(t) sin(W t) is a prescribed motion
/// (mysim/particles.h) along a line. With d the imaginary part of a r(t) e^(iWt), and r a polynomial of degree 5 during
/// the ramp:
///   - during the ramp u, u' and the six functions t^j e^(iWt) are a linear system with constant coefficients, and u is
///     read from its matrix exponential, which stays finite at resonance where undetermined coefficients do not;
///   - afterwards u = Im(Z e^(iWt)) with Z = a (w2 + iW dashpot) / (w2 - W^2 + iW (drag + dashpot)), and a free motion
///     that matches the ramp's end. Exactly at the resonance of an undamped oscillator Z is infinite.
class DrivenMotion {
 public:
  DrivenMotion(double omega2, double drag, double dashpot, double amplitude, const Motion& motion);

  double position(double t) const;  // s -> m
  double velocity(double t) const;  // s -> m/s
  /// A bound of |u| at all times, m: rigorous, at most some tens of percent too large at low frequencies. Infinite at
  /// resonance.
  double amplitude_bound() const;

 private:
  Eigen::Vector2d during_ramp(double t) const;                  // u (m), u' (m/s)
  Eigen::Vector2d steady_state(double t) const;                 // the part with Z
  Eigen::Matrix<std::complex<double>, 8, 8> generator() const;  // 1/s, of (u, u'/w, s^j e^(iWt)), s = t / ramp

  double omega2_, drag_, dashpot_, amplitude_, omega_, ramp_;
  std::complex<double> z_;  // m
  Oscillator after_ramp_;   // from the ramp's end
};

/// u'' = -omega2 (u - participation d) - drag u' - dashpot (u' - participation d') + forcing, where d(t) is the
/// displacement of moved pins along the line. The particles are displaced by u(t) times the shape.
struct Mode {
  double omega2;         // 1/s^2; 0 without springs
  double drag;           // 1/s
  double dashpot;        // 1/s
  double forcing;        // m/s^2, of gravity and steady wind
  double participation;  // 1
  double u0, v0;         // m, m/s, at the start
  Points shape;          // 3 x n, its largest entry 1 or so; 0 at pins
};

struct LinearScene {
  Points rest;  // 3 x n, m: u = 0, where the springs alone would hold the particles; the start, without springs
  std::vector<Mode> modes;
  double base_amplitude = 0;  // m, amplitude of d along the line; 0: the pins stand still

  /// Smallest length that a spring is left with when each mode reaches `amplitude` (m) to either side of `centre` (m)
  /// and moved pins reach `base_amplitude`; 0 or less: it may turn over, and the scene is linear no more. Infinite
  /// without springs.
  double shortest_spring_length(const Model& model, const std::vector<double>& centre,
                                const std::vector<double>& amplitude) const;
};

/// The modes of a scene that is one of these, or nothing:
///   - one free particle under gravity, steady wind and drag: three modes;
///   - Hooke's springs and masses on a line, at least one of them pinned, gravity, steady wind, speeds and the motion
///     of the pins along it, one drag rate for all, and dashpots in proportion to the stiffness (always so with one
///     free mass).
/// Whether a spring turns over is left to the caller.
std::optional<LinearScene> linear_scene(const Scene& scene);

}  // namespace crosscheck
