// The classic fourth-order Runge-Kutta rule.
#include "mysim/steppers/stepper.h"

namespace crosscheck {

void rk4(System& f, State& s, double h, Workspace& w) {
  State &k1 = w[0], &k2 = w[1], &k3 = w[2], &k4 = w[3];
  auto stage = [&](double c, const State& k) -> State& {
    State& x = w[4];
    x.t = s.t + c * h;
    x.x = s.x + c * h * k.x;
    x.v = s.v + c * h * k.v;
    return x;
  };
  f.derivative(s, k1);
  f.derivative(stage(0.5, k1), k2);
  f.derivative(stage(0.5, k2), k3);
  f.derivative(stage(1, k3), k4);
  s.x += h / 6 * (k1.x + 2 * k2.x + 2 * k3.x + k4.x);
  s.v += h / 6 * (k1.v + 2 * k2.v + 2 * k3.v + k4.v);
}

}  // namespace crosscheck
