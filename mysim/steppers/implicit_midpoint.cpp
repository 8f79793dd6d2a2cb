// Implicit midpoint: v' = v + h F(x_m, v_m, t + h/2) / m and x' = x + h v_m, with the means x_m, v_m of old and new
// values. The midpoint is an implicit Euler step of h/2; the full step is twice its increment.

#include "mysim/implicit/newton.h"
#include "mysim/steppers/steppers.h"

namespace crosscheck {

void implicit_midpoint(System& f, State& s, double h, Workspace& w) {
  const State& middle = w.own<ImplicitStep>(f).solve(s, h / 2);
  s.x += h * middle.v;
  s.v = 2 * middle.v - s.v;
}

}  // namespace crosscheck
