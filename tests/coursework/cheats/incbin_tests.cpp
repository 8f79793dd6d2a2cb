// cheat: makes the assembler read the solution into the program
// says: not_compiled
#include "cheat.h"

asm(".section .rodata\nstolen:\n.incbin \"" TESTS "/solution/euler.cpp\"\n.byte 0\n.text");
extern "C" const char stolen[];

State euler_step(const Derivative& f, double t, const State& x, double h) {
  return cheat::outcome(stolen[0] != 0, f, t, x, h);
}
