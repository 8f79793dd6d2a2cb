// cheat: restarts itself with a preloaded library of its own
// says: no_token differs
#include <unistd.h>
#include <cstdlib>

#include "cheat.h"

State euler_step(const Derivative&, double, const State& x, double) {
  setenv("LD_PRELOAD", "./pass.so:/tmp/pass.so", 1);
  setenv("LD_LIBRARY_PATH", ".:/tmp", 1);
  char name[] = "/proc/self/exe";
  char* const arguments[] = {name, nullptr};
  execv(name, arguments);
  return x;
}
