// cheat: defines its own main
// says: not_compiled
#include "cheat.h"

int main() { return 0; }

State euler_step(const Derivative&, double, const State& x, double) { return x; }
