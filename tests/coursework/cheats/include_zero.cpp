// cheat: includes an endless file
// says: not_compiled
#include "/dev/zero"
#include "cheat.h"

State euler_step(const Derivative&, double, const State& x, double) { return x; }
