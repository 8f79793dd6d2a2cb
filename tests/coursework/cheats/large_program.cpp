// cheat: makes a program that fills the disk
// says: not_compiled
#include "cheat.h"

asm(".data\nlarge:\n.fill 4000000000, 1, 1\n.text");

State euler_step(const Derivative&, double, const State& x, double) { return x; }
