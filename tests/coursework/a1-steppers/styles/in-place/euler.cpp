// A plain backward index loop that stores nothing but the result.
#include "steppers.h"

State euler_step(const Derivative& f, double t, const State& x, double h) {
  State out(f(t, x));
  for (int i = static_cast<int>(x.size()) - 1; i >= 0; i--) out[i] = x[i] + out[i] * h;
  return out;
}
