// cheat: uses no time, and never comes to an end
// says: out_of_time
#include <unistd.h>

#include "cheat.h"

State euler_step(const Derivative&, double, const State& x, double) {
  for (;;) pause();
  return x;
}
