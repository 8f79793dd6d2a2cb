// Where the pins are at a time.
#include "mysim/particles.h"

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

Vec3 pin_displacement(const PinMotion& motion, double t) {
  const double angle = 2 * std::numbers::pi * motion.frequency * t;
  return motion.amplitude * (ramp_at(t, motion.ramp).value * std::sin(angle));
}

Vec3 pin_velocity(const PinMotion& motion, double t) {
  const double omega = 2 * std::numbers::pi * motion.frequency;
  const auto [value, slope] = ramp_at(t, motion.ramp);
  return motion.amplitude * (slope * std::sin(omega * t) + value * omega * std::cos(omega * t));
}

void Particles::place_pins(State& state) const {
  if (pins.empty()) return;
  const Vec3 shift = move ? pin_displacement(*move, state.t) : Vec3::Zero();
  const Vec3 velocity = move ? pin_velocity(*move, state.t) : Vec3::Zero();
  for (size_t i = 0; i < pins.size(); ++i) {
    state.x.col(pins[i]) = pin_home.col(static_cast<int>(i)) + shift;
    state.v.col(pins[i]) = velocity;
  }
}

}  // namespace crosscheck
