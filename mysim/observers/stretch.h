// The longest that the springs of a hanging scene can get by any motion that keeps the energy balance.
#pragma once

#include <vector>

#include "mysim/model.h"

namespace crosscheck {

/// A particle that hangs from a pin on a path of springs sinks by at most D + sum(s), where D is its distance from that
/// pin at the start plus the path's length at rest and s are the extensions along it. With W the whole weight, a wind's
/// force counted in, and E the energy from elsewhere, an extension s_j of a spring of k_j then obeys
///   k_j s_j^2 / 2 + sum_others k s^2 / 2 <= E + W (D + sum s),
/// and since W s - k s^2 / 2 is at most W^2 / (2 k) for each of the n others,
///   s_j <= (W + sqrt(W^2 + 2 k_j B)) / k_j,  B = E + W D + n W^2 / (2 k_min).
/// Energy alone does not see a net that sinks for ever and loses what gravity gives: this does. Links of the
/// position-based law store no less than Hooke's springs, so that it holds for them too. Close to its limit a stable
/// symplectic rule swings further than energy says, by 1 / sqrt(1 - (h omega / 2)^2): ten times as far half a per cent
/// below it. Ten times the length is what is allowed.
class StretchBound {
 public:
  /// Inactive where some free particle hangs from no pin, or air presses on triangles: its force has no bound here.
  StretchBound(const Model& model, const State& start);
  /// True where a spring is longer than the bound allows; energy: E, J, kinetic and elastic at the start and all work.
  bool exceeded(const State& state, double energy) const;

 private:
  const Model& model_;
  bool active_ = false;
  double weight_ = 0;  // N, of gravity and wind
  double led_ = 0;     // m, the furthest that pins are led from where they were
  double sunk_ = 0;    // J, W D + n W^2 / (2 k_min)
};

}  // namespace crosscheck
