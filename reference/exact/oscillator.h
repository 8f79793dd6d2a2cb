// The damped harmonic oscillator u'' = -w2 u - gamma u', in its three regimes.
#pragma once

#include <cmath>

namespace crosscheck {

struct Oscillator {
  double w2;     // k / m, 1/s^2
  double gamma;  // c / m, 1/s
  double u0;     // m
  double v0;     // m/s

  double position(double t) const {
    const auto [c, s] = parts(t);
    return u0 * c + (v0 + gamma / 2 * u0) * s;
  }
  double velocity(double t) const {
    const auto [c, s] = parts(t);
    // d/dt of the above: without the decay, c' = (gamma^2/4 - w2) s and s' = c hold in all regimes
    return v0 * c - (w2 * u0 + gamma / 2 * v0) * s;
  }
  /// A bound of |u| at all times, from the energy at the start.
  double largest() const { return std::sqrt(u0 * u0 + v0 * v0 / w2); }

 private:
  struct Parts {
    double c, s;  // e^(-gamma t / 2) times cos(w t) and sin(w t) / w, or cosh and sinh / w, or 1 and t
  };
  Parts parts(double t) const {
    const double d = w2 - gamma * gamma / 4, w = std::sqrt(std::abs(d)), decay = std::exp(-gamma / 2 * t);
    if (d > 0) return {decay * std::cos(w * t), decay * std::sin(w * t) / w};
    if (d == 0) return {decay, decay * t};
    // by the slow exponent gamma/2 - w, written without its cancellation: exp and cosh apart would be 0 times infinity
    const double slow = std::exp(-w2 / (gamma / 2 + w) * t);
    return {slow * (1 + std::exp(-2 * w * t)) / 2, slow * -std::expm1(-2 * w * t) / (2 * w)};
  }
};

}  // namespace crosscheck
