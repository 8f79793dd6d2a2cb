// cheat: makes the compiler print endless errors
// says: not_compiled
#include "cheat.h"

#define A(x) x x x x x x x x
#define B(x) A(A(A(A(x))))
#define C(x) B(B(x))
C(; nonsense +->)

State euler_step(const Derivative&, double, const State& x, double) { return x; }
