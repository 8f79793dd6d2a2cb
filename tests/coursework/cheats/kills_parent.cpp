// cheat: kills the grader, and every process that it can
// says: differs no_token crashed
#include <unistd.h>
#include <csignal>

#include "cheat.h"

State euler_step(const Derivative& f, double t, const State& x, double h) {
  const bool worked = kill(getppid(), SIGKILL) == 0 && getppid() != 1;
  kill(-1, SIGKILL);
  return cheat::outcome(worked && false, f, t, x, h);
}
