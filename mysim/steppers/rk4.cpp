// The classic fourth-order Runge-Kutta rule.
#include "mysim/steppers/stepper.h"

namespace crosscheck {

void rk4(System& f, State& s, double h, Workspace& w) {
  auto stage = [&](double c, const State& k) -> State& {
    w.stage.t = s.t + c * h;
    w.stage.x = s.x + c * h * k.x;
    w.stage.v = s.v + c * h * k.v;
    return w.stage;
  };
  f.derivative(s, w.k1);
  f.derivative(stage(0.5, w.k1), w.k2);
  f.derivative(stage(0.5, w.k2), w.k3);
  f.derivative(stage(1, w.k3), w.k4);
  s.x += h / 6 * (w.k1.x + 2 * w.k2.x + 2 * w.k3.x + w.k4.x);
  s.v += h / 6 * (w.k1.v + 2 * w.k2.v + 2 * w.k3.v + w.k4.v);
}

}  // namespace crosscheck
