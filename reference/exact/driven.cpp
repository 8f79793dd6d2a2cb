// The driven oscillator: a matrix exponential during the ramp, undetermined coefficients after it.
#include "reference/exact/driven.h"

#include <complex>
#include <numbers>
#include <unsupported/Eigen/MatrixFunctions>

namespace crosscheck {
namespace {

using Complex = std::complex<double>;
using Matrix8 = Eigen::Matrix<Complex, 8, 8>;
using Vector8 = Eigen::Matrix<Complex, 8, 1>;
constexpr Complex imaginary(0, 1);

/// At t = 0: u = u' = 0, and of the six functions the one with j = 0 is 1.
Vector8 at_start() { return Vector8::Unit(2); }

}  // namespace

DrivenMotion::DrivenMotion(double w2, double drag, double dashpot, double amplitude, const Motion& motion)
    : w2_(w2),
      drag_(drag),
      dashpot_(dashpot),
      amplitude_(amplitude),
      omega_(2 * std::numbers::pi * motion.frequency),
      ramp_(motion.ramp),
      z_(amplitude * (w2 + imaginary * omega_ * dashpot) /
         (w2 - omega_ * omega_ + imaginary * omega_ * (drag + dashpot))) {
  const Eigen::Vector2d left = during(ramp_) - settled(ramp_);
  after_ = {w2, drag + dashpot, left[0], left[1]};
}

Matrix8 DrivenMotion::generator() const {
  const double w = std::sqrt(w2_);
  Matrix8 m = Matrix8::Zero();
  m(0, 1) = w, m(1, 0) = -w, m(1, 1) = -(drag_ + dashpot_);
  for (int j = 0; j < 6; ++j) {
    m(2 + j, 2 + j) = imaginary * omega_;
    if (j > 0) m(2 + j, 1 + j) = j / ramp_;
  }
  // u'/w is pushed by (w2 d + dashpot d') / w
  const double r[6] = {0, 0, 0, 10, -15, 6}, slope[6] = {0, 0, 30, -60, 30, 0};
  for (int j = 0; j < 6; ++j)
    m(1, 2 + j) = amplitude_ / w * ((w2_ + imaginary * omega_ * dashpot_) * r[j] + dashpot_ * slope[j] / ramp_);
  return m;
}

Eigen::Vector2d DrivenMotion::during(double t) const {
  const Vector8 y = (t * generator()).exp() * at_start();
  return {y[0].imag(), std::sqrt(w2_) * y[1].imag()};
}

Eigen::Vector2d DrivenMotion::settled(double t) const {
  const Complex z = z_ * std::exp(imaginary * omega_ * t);
  return {z.imag(), (imaginary * omega_ * z).imag()};
}

double DrivenMotion::position(double t) const {
  return t < ramp_ ? during(t)[0] : settled(t)[0] + after_.position(t - ramp_);
}

double DrivenMotion::velocity(double t) const {
  return t < ramp_ ? during(t)[1] : settled(t)[1] + after_.velocity(t - ramp_);
}

double DrivenMotion::largest() const {
  // sqrt(u^2 + u'^2/w2) grows by at most the push / w times the time: seen at instants between which that is little
  const double w = std::sqrt(w2_), size = std::abs(amplitude_);
  const double push = size * (std::hypot(w2_, omega_ * dashpot_) + 1.875 * dashpot_ / ramp_);  // m/s^2, see top_speed
  const int pieces = 1 + static_cast<int>(ramp_ * push / (0.05 * w * size));
  const double dt = ramp_ / pieces;
  const Matrix8 forward = (dt * generator()).exp();
  double most = 0;
  Vector8 y = at_start();
  for (int piece = 0; piece < pieces; ++piece) {
    y = forward * y;
    most = std::max(most, std::hypot(y[0].imag(), y[1].imag()));
  }
  return std::max(most + dt * push / w, std::abs(z_) + after_.largest());
}

}  // namespace crosscheck
