// cheat: brings a main of its own
// says: not_compiled
#include "cheat.h"

int main() { return 0; }

State euler_step(const Derivative&, double, const State& x, double) { return x; }
