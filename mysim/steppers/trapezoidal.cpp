// Explicit trapezoidal rule: f0 = f(X, t), f1 = f(X + h f0, t + h), X(t+h) = X + h/2 (f0 + f1).
#include "mysim/steppers/stepper.h"

namespace crosscheck {

void trapezoidal(System& f, State& s, double h, Workspace& w) {
  f.derivative(s, w.k1);
  w.stage.t = s.t + h;
  w.stage.x = s.x + h * w.k1.x;
  w.stage.v = s.v + h * w.k1.v;
  f.derivative(w.stage, w.k2);
  s.x += h / 2 * (w.k1.x + w.k2.x);
  s.v += h / 2 * (w.k1.v + w.k2.v);
}

}  // namespace crosscheck
