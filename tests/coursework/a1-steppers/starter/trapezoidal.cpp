// The explicit trapezoidal rule.
#include "steppers.h"

State trapezoidal_step(const Derivative& f, double t, const State& x, double h) {
  (void)f, (void)t, (void)h;  // delete this line when you use them
  return x;                   // yours
}
