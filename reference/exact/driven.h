// What a driven oscillator adds to its free motion.
#pragma once

#include <Eigen/Core>

#include "mysim/motion.h"
#include "reference/exact/oscillator.h"

namespace crosscheck {

/// u'' = -w2 (u - d) - drag u' - dashpot (u' - d') from rest at u = 0, where d = a r(t) sin(W t) is a prescribed motion
/// (motion.h) along a line. With d the imaginary part of a r(t) e^(iWt), and r a polynomial of degree 5 during the
/// ramp:
///   - during the ramp u, u' and the six functions t^j e^(iWt) are a linear system with constant coefficients, and u is
///     read from its matrix exponential, which stays finite at resonance where undetermined coefficients do not;
///   - afterwards u = Im(Z e^(iWt)) with Z = a (w2 + iW dashpot) / (w2 - W^2 + iW (drag + dashpot)), and a free motion
///     that matches the ramp's end. Exactly at the resonance of an undamped oscillator Z is infinite.
class DrivenMotion {
 public:
  DrivenMotion(double w2, double drag, double dashpot, double amplitude, const Motion& motion);

  double position(double t) const;  // s -> m
  double velocity(double t) const;  // s -> m/s
  /// A bound of |u| at all times, m: rigorous, at most some tens of percent too large at low frequencies. Infinite at
  /// resonance.
  double largest() const;

 private:
  Eigen::Vector2d during(double t) const;                       // u (m), u' (m/s)
  Eigen::Vector2d settled(double t) const;                      // the part with Z
  Eigen::Matrix<std::complex<double>, 8, 8> generator() const;  // 1/s, of (u, u'/w, s^j e^(iWt)), s = t / ramp

  double w2_, drag_, dashpot_, amplitude_, omega_, ramp_;
  std::complex<double> z_;  // m
  Oscillator after_;        // from the ramp's end
};

}  // namespace crosscheck
