// cheat: passes options to compiler and linker from within the file
// says: not_compiled differs
#include "cheat.h"

#pragma GCC optimize("-fplugin=/tmp/pass.so")
#pragma comment(linker, "/include:pass")
asm(".section .note.GNU-stack,\"x\",@progbits\n.text");

State euler_step(const Derivative&, double, const State& x, double) { return x; }
