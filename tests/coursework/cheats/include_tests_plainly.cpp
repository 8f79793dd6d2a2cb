// cheat: includes the solution
// says: not_compiled
#include TESTS "/solution/euler.cpp"
#include "cheat.h"
