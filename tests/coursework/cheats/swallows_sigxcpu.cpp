// cheat: ignores the signal for exceeded time
// says: out_of_time as_ungraded
#include <csignal>

#include "cheat.h"

State euler_step(const Derivative&, double, const State& x, double) {
  for (const int number : {SIGXCPU, SIGTERM, SIGALRM, SIGINT, SIGHUP}) std::signal(number, [](int) {});
  volatile bool more = true;
  while (more) {
  }
  return x;
}
