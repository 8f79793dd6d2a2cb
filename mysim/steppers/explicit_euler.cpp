// Forward Euler: X(t+h) = X + h f(X, t).

#include "mysim/steppers/steppers.h"

namespace crosscheck {

void explicit_euler(System& f, State& s, double h, Workspace& w) {
  State& k = w[0];
  f.derivative(s, k);
  s.x += h * k.x;
  s.v += h * k.v;
}

}  // namespace crosscheck
