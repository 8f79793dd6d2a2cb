// cheat: includes itself twice, two hundred levels deep
// says: not_compiled
#include "cheat.h"
#include "euler.cpp"

State euler_step(const Derivative&, double, const State& x, double) { return x; }
