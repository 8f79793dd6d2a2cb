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
    return std::exp(-gamma / 2 * t) * (u0 * c + (v0 + gamma / 2 * u0) * s);
  }
  double velocity(double t) const {
    const auto [c, s] = parts(t);
    // d/dt of the above; c' = (gamma^2/4 - w2) s and s' = c hold in all regimes
    return std::exp(-gamma / 2 * t) * (v0 * c - (w2 * u0 + gamma / 2 * v0) * s);
  }
  /// A bound of |u| at all times, from the energy at the start.
  double largest() const { return std::sqrt(u0 * u0 + v0 * v0 / w2); }

 private:
  struct Parts {
    double c, s;  // cos(w t) and sin(w t) / w, or cosh and sinh / w, or 1 and t
  };
  Parts parts(double t) const {
    const double d = w2 - gamma * gamma / 4;
    if (d > 0) return {std::cos(std::sqrt(d) * t), std::sin(std::sqrt(d) * t) / std::sqrt(d)};
    if (d < 0) return {std::cosh(std::sqrt(-d) * t), std::sinh(std::sqrt(-d) * t) / std::sqrt(-d)};
    return {1, t};
  }
};

}  // namespace crosscheck
