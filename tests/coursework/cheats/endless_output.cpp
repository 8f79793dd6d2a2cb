// cheat: prints endlessly
// says: too_much_output
#include <cstdio>

#include "cheat.h"

State euler_step(const Derivative&, double, const State& x, double) {
  for (;;) std::puts("all tests passed");
  return x;
}
