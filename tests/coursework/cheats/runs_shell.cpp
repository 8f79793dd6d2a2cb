// cheat: runs a shell, a compiler and the package tools
// says: differs
#include <cstdlib>

#include "cheat.h"

State euler_step(const Derivative& f, double t, const State& x, double h) {
  const bool worked = std::system("echo worked >&3; cp " TESTS "/solution/euler.cpp " RESULTS) == 0;
  return cheat::outcome(worked, f, t, x, h);
}
