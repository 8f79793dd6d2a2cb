// Explicit trapezoidal rule: f0 = f(X, t), f1 = f(X + h f0, t + h), X(t+h) = X + h/2 (f0 + f1).

#include "mysim/steppers/steppers.h"

namespace crosscheck {

void trapezoidal(System& f, State& s, double h, Workspace& w) {
  State &f0 = w[0], &f1 = w[1], &stage = w[2];
  f.derivative(s, f0);
  stage.t = s.t + h;
  stage.x = s.x + h * f0.x;
  stage.v = s.v + h * f0.v;
  f.derivative(stage, f1);
  s.x += h / 2 * (f0.x + f1.x);
  s.v += h / 2 * (f0.v + f1.v);
}

}  // namespace crosscheck
