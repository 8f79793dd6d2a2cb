// cheat: never ends
// says: out_of_time as_ungraded
#include "cheat.h"

State euler_step(const Derivative&, double, const State& x, double) {
  volatile bool more = true;
  while (more) {
  }
  return x;
}
