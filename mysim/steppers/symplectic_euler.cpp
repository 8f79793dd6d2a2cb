// Symplectic Euler: kick with the force at x_n (drag at v_n), then drift with the new velocity.

#include "mysim/steppers/steppers.h"

namespace crosscheck {

void symplectic_euler(System& f, State& s, double h, Workspace& w) {
  Points& a = w[0].v;
  f.acceleration(s, a);
  s.v += h * a;
  s.x += h * s.v;
}

KickDriftComposition symplectic_euler_composition() { return {{1}, true}; }

}  // namespace crosscheck
