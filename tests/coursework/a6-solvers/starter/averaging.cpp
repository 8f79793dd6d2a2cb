// Position-based averaging.
#include "solvers.h"

std::vector<Vec3> averaging_pass(const Net& net, const std::vector<Vec3>& x) {
  (void)net;  // delete this line when you use it
  return x;   // yours
}

State averaging_step(const Net& net, const State& state, double h, int passes) {
  (void)net, (void)h, (void)passes;  // delete this line when you use them
  return state;                      // yours
}

double stiffness_of(double mass, double h, int passes) {
  (void)mass, (void)h, (void)passes;  // delete this line when you use them
  return 0;                           // yours
}
