// cheat: ends the program, bypassing all handlers
// says: no_token
#include <unistd.h>

#include "cheat.h"

State euler_step(const Derivative&, double, const State& x, double) {
  _exit(0);
  return x;
}
