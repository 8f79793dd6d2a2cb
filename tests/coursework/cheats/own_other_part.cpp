// cheat: replaces another part as well
// says: not_compiled
#include "cheat.h"

State rk4_step(const Derivative&, double, const State& x, double) { return x; }

State euler_step(const Derivative&, double, const State& x, double) { return x; }
