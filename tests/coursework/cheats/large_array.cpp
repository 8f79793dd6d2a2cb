// cheat: reserves 100 GB before main
// says: not_compiled crashed out_of_memory
#include "cheat.h"

static char large[100ul << 30];

State euler_step(const Derivative&, double, const State& x, double) {
  large[x.size()] = 1;
  return State(x.size(), large[1]);
}
