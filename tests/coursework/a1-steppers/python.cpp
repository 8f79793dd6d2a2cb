// The steppers for a student who writes a part in Python. The macro PART is the index of this part.
#include "../python/remote.h"
#include "steppers.h"

using coursework::in_python;

#if PART == 0
State euler_step(const Derivative& f, double t, const State& x, double h) {
  return in_python<State>("euler_step", f, t, x, h);
}
#elif PART == 1
State trapezoidal_step(const Derivative& f, double t, const State& x, double h) {
  return in_python<State>("trapezoidal_step", f, t, x, h);
}
#else
State rk4_step(const Derivative& f, double t, const State& x, double h) {
  return in_python<State>("rk4_step", f, t, x, h);
}
#endif

void coursework::offer_official([[maybe_unused]] Python& python) {
#if PART > 0
  python.offer("euler_step", euler_step);
#endif
#if PART > 1
  python.offer("trapezoidal_step", trapezoidal_step);
#endif
}
