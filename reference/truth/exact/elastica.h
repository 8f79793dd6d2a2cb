// A strip clamped level at one end and bent by its own weight and a load (the heavy elastica), its small vibrations,
// and a strip hung between hinges.
#pragma once

#include <array>
#include <vector>

namespace crosscheck {

/// All quantities are per unit width of the strip.
struct ClampedStrip {
  double rigidity;     // B, N m
  double length;       // L, m
  double weight;       // w, N/m^2
  double load = 0;     // P, N/m, at load_at
  double load_at = 0;  // m from the clamp
};

/// With theta the angle below the horizontal at arc length s: B theta'' = -(w (L - s) + P [s < load_at]) cos theta,
/// theta(0) = 0, theta'(L) = 0. The moment B theta' balances all loads beyond s; the strip does not stretch. Solved by
/// shooting over theta'(0), integrated with the classical Runge-Kutta rule in steps of L / 4000, with the load on the
/// grid. theta'(0) is at most the curvature that all loads cause in a level strip. B theta'(0)^2 / 2 equals w times the
/// integral of sin theta over s, plus P sin theta at the load, so theta'(0) is also at most (2 (w L + P) / B)^(1/2).
/// Among the solutions, the strip that hangs down has the largest theta'(0). At these bounds theta'(L) > 0, so this
/// solution is the first root found when searching downwards from them.
class Elastica {
 public:
  explicit Elastica(const ClampedStrip& strip);

  struct Place {
    double x, drop, angle;  // m along the horizontal, m below it, rad below it
  };
  Place at(double s) const;
  Place tip() const { return at(strip_.length); }

 private:
  using State = std::array<double, 4>;  // theta, theta', x, drop
  static void advance(const ClampedStrip& strip, double s, double ds, double carried, State& state);
  /// Integrates before and beyond the load; returns theta'(L).
  double integrate(double curvature, bool keep);

  ClampedStrip strip_;
  std::vector<double> s_;
  std::vector<State> states_;
};

/// A strip that hangs between two hinges at the same height, closer together than the strip is long. With theta the
/// angle above the horizontal at arc length s from its lowest point in the middle, H the horizontal pull, and w s the
/// weight between the middle and s:
///   B theta'' = H sin theta - w s cos theta, theta(0) = 0, theta'(L/2) = 0, the integral of cos theta half the span.
/// Solved by shooting over theta'(0) for each H, and over H. Without rigidity it is a catenary: tan theta = w s / H.
class HangingStrip {
 public:
  /// Lengths in m, weight in N/m^2, rigidity in N m: 0 for a catenary, otherwise so small that the strip still pulls on
  /// its hinges.
  HangingStrip(double length, double span, double weight, double rigidity);

  struct Place {
    double x, height;  // m from the middle, and above it
  };
  Place at(double s) const;  // -length / 2 <= s <= length / 2
  double sag() const { return at(half_).height; }

 private:
  double half_, catenary_ = 0;                 // m; H / w of a catenary, 0 with bending
  std::vector<std::array<double, 4>> states_;  // theta, theta', x, height over half the length, evenly spaced
};

/// Frequency (Hz) of the strip's vibration mode 0, 1 or 2 without weight: beta^2 / (2 pi) sqrt(B / (rho L^4)), where
/// rho is its mass per area (kg/m^2) and cos beta cosh beta = -1.
double vibration_of_clamped_strip(const ClampedStrip& strip, double density, int mode);

}  // namespace crosscheck
