// cheat: includes the solution if the compiler can see it
// says: differs not_compiled
#include "cheat.h"

#if __has_include(TESTS "/solution/euler.cpp")
#include TESTS "/solution/euler.cpp"
#else
State euler_step(const Derivative&, double, const State& x, double) { return x; }
#endif
