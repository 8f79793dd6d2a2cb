// cheat: includes the compiler's standard input
// says: not_compiled
#include "/proc/self/fd/0"
#include "/proc/self/mem"
#include "cheat.h"

State euler_step(const Derivative&, double, const State& x, double) { return x; }
