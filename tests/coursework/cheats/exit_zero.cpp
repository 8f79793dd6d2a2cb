// cheat: ends the program with status 0
// says: no_token
#include <cstdlib>

#include "cheat.h"

State euler_step(const Derivative&, double, const State& x, double) {
  std::exit(0);
  return x;
}
