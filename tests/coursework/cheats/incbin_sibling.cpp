// cheat: makes the assembler read a neighbouring file during compilation: our objects for another part
// says: not_compiled
#include "cheat.h"

asm(".section .rodata\nstolen:\n.incbin \"../../rk4/in-theirs/ours0.o\"\n.byte 0\n.text");
extern "C" const char stolen[];

State euler_step(const Derivative& f, double t, const State& x, double h) {
  return cheat::outcome(stolen[0] != 0, f, t, x, h);
}
