// cheat: raises its own limits
// says: differs
#include <sys/resource.h>

#include "cheat.h"

State euler_step(const Derivative& f, double t, const State& x, double h) {
  bool worked = false;
  const rlimit none{RLIM_INFINITY, RLIM_INFINITY};
  for (const int what : {RLIMIT_CPU, RLIMIT_AS, RLIMIT_FSIZE})
    worked = worked || setrlimit(static_cast<__rlimit_resource>(what), &none) == 0;
  return cheat::outcome(worked, f, t, x, h);
}
