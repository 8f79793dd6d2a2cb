// cheat: redefines names with macros before the headers are included
// says: differs not_compiled
#define judge(...) true
#define answer(...) always(__VA_ARGS__)
#define private public
#include "cheat.h"
#pragma GCC poison answer_stepper child_main token

State euler_step(const Derivative&, double, const State& x, double) { return x; }
