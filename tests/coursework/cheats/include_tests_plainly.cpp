// cheat: takes the solution by #include
// says: not_compiled
#include TESTS "/solution/euler.cpp"
#include "cheat.h"
