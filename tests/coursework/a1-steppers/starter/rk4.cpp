// The classic Runge-Kutta rule of order 4.
#include "steppers.h"

State rk4_step(const Derivative& f, double t, const State& x, double h) {
  (void)f, (void)t, (void)h;  // delete this line when you use them
  return x;                   // yours
}
