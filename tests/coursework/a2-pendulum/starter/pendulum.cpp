// One particle that hangs on a fixed one.
#include "pendulum.h"

State pendulum_derivative(const Pendulum& pendulum, const State& state) {
  (void)pendulum;              // delete this line when you use it
  return State(state.size());  // yours
}
