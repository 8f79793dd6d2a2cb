// Explicit Euler.
#include "steppers.h"

State euler_step(const Derivative& f, double t, const State& x, double h) {
  (void)f, (void)t, (void)h;  // delete this line when you use them
  return x;                   // yours
}
