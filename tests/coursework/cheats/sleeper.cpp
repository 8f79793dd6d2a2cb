// cheat: sleeps, and never ends
// says: waiting out_of_time as_ungraded
#include <unistd.h>

#include "cheat.h"

State euler_step(const Derivative&, double, const State& x, double) {
  for (;;) pause();
  return x;
}
