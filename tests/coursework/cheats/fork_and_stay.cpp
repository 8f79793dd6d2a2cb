// cheat: leaves a process behind that waits for the grader to finish
// says: differs
#include <unistd.h>

#include "cheat.h"

State euler_step(const Derivative& f, double t, const State& x, double h) {
  const pid_t child = fork();
  if (child == 0) {
    setsid();
    for (;;) sleep(1);
  }
  return cheat::outcome(child > 0, f, t, x, h);
}
