// Where the pins are at a time.
#include "mysim/particles.h"

namespace crosscheck {

void Particles::place_pins(State& state) const {
  if (pins.empty()) return;
  const Vec3 shift = move ? displacement_at(*move, state.t) : Vec3::Zero();
  for (size_t i = 0; i < pins.size(); ++i) state.x.col(pins[i]) = pin_home.col(static_cast<int>(i)) + shift;
  place_pin_velocities(state);
}

void Particles::place_pin_velocities(State& state) const {
  const Vec3 velocity = move ? velocity_at(*move, state.t) : Vec3::Zero();
  for (int pin : pins) state.v.col(pin) = velocity;
}

}  // namespace crosscheck
