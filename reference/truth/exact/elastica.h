// A strip clamped level at one end, bent by its own weight and by a load: the heavy elastica, as a two-point problem;
// and its small vibrations.
#pragma once

#include <array>
#include <vector>

namespace crosscheck {

/// Per width of the strip.
struct ClampedStrip {
  double rigidity;     // B, N m
  double length;       // L, m
  double weight;       // w, N/m^2
  double load = 0;     // P, N/m, hung on
  double load_at = 0;  // m from the clamp
};

/// With theta the angle below the level at arc length s, B theta'' = -(w (L - s) + P [s < load_at]) cos theta,
/// theta(0) = 0, theta'(L) = 0 (the moment B theta' balances what hangs beyond s; no stretch). Solved by shooting over
/// theta'(0), integrated by classical Runge-Kutta in steps of L / 4000 with the load's place on the grid. theta'(0) is
/// at most what all loads give on a level strip; and since B theta'(0)^2 / 2 is the integral of the loads over sin
/// theta, w times that of sin theta over s and P sin theta at the load, it is at most (2 (w L + P) / B)^(1/2), and
/// largest for the strip that hangs down: the root sought is the first one below these bounds, at which theta'(L) > 0.
class Elastica {
 public:
  explicit Elastica(const ClampedStrip& strip);

  struct Place {
    double x, drop, angle;  // m along the level, m below it, rad below it
  };
  Place at(double s) const;
  Place tip() const { return at(strip_.length); }

 private:
  using State = std::array<double, 4>;  // theta, theta', x, drop
  static void advance(const ClampedStrip& strip, double s, double ds, double carried, State& state);
  /// Both parts, before and behind the load; returns theta'(L).
  double integrate(double curvature, bool keep);

  ClampedStrip strip_;
  std::vector<double> s_;
  std::vector<State> states_;
};

/// A strip that hangs between two hinges on one level, closer to each other than it is long. With theta the angle above
/// the level at arc length s from its middle, where it is lowest, H the pull along the level and w s the weight
/// between,
///   B theta'' = H sin theta - w s cos theta, theta(0) = 0, theta'(L/2) = 0, the integral of cos theta half the span.
/// Solved by shooting over theta'(0), for each H, and over H. Without rigidity it is a catenary in closed form:
/// tan theta = w s / H.
class HangingStrip {
 public:
  /// Lengths in m, weight in N/m^2, rigidity in N m (0: none; at most so much that the hinges still pull).
  HangingStrip(double length, double span, double weight, double rigidity);

  struct Place {
    double x, height;  // m from the middle, above it
  };
  Place at(double s) const;  // from -length / 2 to length / 2
  double sag() const { return at(half_).height; }

 private:
  double half_, catenary_ = 0;                 // m; H / w of a catenary, 0 with bending
  std::vector<std::array<double, 4>> states_;  // theta, theta', x, height over half the length, evenly spaced
};

/// Frequency (Hz) of the strip's first, second or third vibration without weight (mode 0 to 2): beta^2 / (2 pi)
/// sqrt(B / (rho L^4)), rho its mass per area (kg/m^2), cos beta cosh beta = -1.
double vibration_of_clamped_strip(const ClampedStrip& strip, double density, int mode);

}  // namespace crosscheck
