// cheat: throws something that is no exception
// says: threw
#include "cheat.h"

State euler_step(const Derivative&, double, const State& x, double) {
  throw 42;
  return x;
}
