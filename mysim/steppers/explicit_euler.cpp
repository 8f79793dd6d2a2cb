// Forward Euler: X(t+h) = X + h f(X, t).
#include "mysim/steppers/stepper.h"

namespace crosscheck {

void explicit_euler(System& f, State& s, double h, Workspace& w) {
  f.derivative(s, w.k1);
  s.x += h * w.k1.x;
  s.v += h * w.k1.v;
}

}  // namespace crosscheck
