// cheat: starts processes endlessly
// says: out_of_time differs as_ungraded
#include <unistd.h>

#include "cheat.h"

State euler_step(const Derivative&, double, const State& x, double) {
  for (;;) fork();
  return x;
}
