#include "mysim/particles.h"

#include <cassert>
#include <numbers>

#include "mysim/portable_trigonometry.h"

namespace crosscheck {
namespace {

struct Ramp {
  double value, slope;  // dimensionless, 1/s
};

Ramp ramp_at(double t, double length) {
  if (t >= length) return {1, 0};
  const double s = t / length;
  return {s * s * s * (10 + s * (6 * s - 15)), 30 * s * s * (1 - s) * (1 - s) / length};
}

}  // namespace

double max_speed(const Motion& motion) {
  return motion.amplitude.norm() * (2 * std::numbers::pi * motion.frequency + 1.875 / motion.ramp);
}

Vec3 displacement_at(const Motion& motion, double t) {
  const double angle = 2 * std::numbers::pi * motion.frequency * t;
  return motion.amplitude * (ramp_at(t, motion.ramp).value * portable_sin(angle));
}

Vec3 velocity_at(const Motion& motion, double t) {
  const double omega = 2 * std::numbers::pi * motion.frequency;
  const auto [value, slope] = ramp_at(t, motion.ramp);
  return motion.amplitude * (slope * portable_sin(omega * t) + value * omega * portable_cos(omega * t));
}

void Particles::place_pins(State& state) const {
  if (pins.empty()) return;
  assert(state.x.cols() == size() && pin_home.cols() == static_cast<Eigen::Index>(pins.size()));
  const Vec3 shift = move ? displacement_at(*move, state.t) : Vec3::Zero();
  for (size_t i = 0; i < pins.size(); ++i) state.x.col(pins[i]) = pin_home.col(static_cast<int>(i)) + shift;
  place_pin_velocities(state);
}

void Particles::place_pin_velocities(State& state) const {
  const Vec3 velocity = move ? velocity_at(*move, state.t) : Vec3::Zero();
  for (int pin : pins) state.v.col(pin) = velocity;
}

}  // namespace crosscheck
