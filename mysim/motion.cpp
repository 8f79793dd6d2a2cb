// The prescribed motion and its derivative.
#include "mysim/motion.h"

#include <cmath>
#include <numbers>

namespace crosscheck {
namespace {

struct Ramp {
  double value, slope;  // 1, 1/s
};

Ramp ramp_at(double t, double length) {
  if (t >= length) return {1, 0};
  const double s = t / length;
  return {s * s * s * (10 + s * (6 * s - 15)), 30 * s * s * (1 - s) * (1 - s) / length};
}

}  // namespace

double top_speed(const Motion& motion) {
  return motion.amplitude.norm() * (2 * std::numbers::pi * motion.frequency + 1.875 / motion.ramp);
}

Vec3 displacement_at(const Motion& motion, double t) {
  const double angle = 2 * std::numbers::pi * motion.frequency * t;
  return motion.amplitude * (ramp_at(t, motion.ramp).value * std::sin(angle));
}

Vec3 velocity_at(const Motion& motion, double t) {
  const double omega = 2 * std::numbers::pi * motion.frequency;
  const auto [value, slope] = ramp_at(t, motion.ramp);
  return motion.amplitude * (slope * std::sin(omega * t) + value * omega * std::cos(omega * t));
}

}  // namespace crosscheck
