// Implicit (backward) Euler: v' = v + h F(x', v', t') / m, x' = x + h v'. Drag is implicit too.

#include "mysim/implicit/newton.h"
#include "mysim/steppers/steppers.h"

namespace crosscheck {

void implicit_euler(System& f, State& s, double h, Workspace& w) {
  const State& end = w.own<ImplicitStep>(f).solve(s, h);
  s.x = end.x;
  s.v = end.v;
}

void implicit_euler_linear(System& f, State& s, double h, Workspace& w) {
  const State& end = w.own<ImplicitStep>(f).solve_linear(s, h);
  s.x = end.x;
  s.v = end.v;
}

}  // namespace crosscheck
