// cheat: leaves a thread behind that would change the answers later
// says: threw differs
#include <thread>

#include "cheat.h"

State euler_step(const Derivative&, double, const State& x, double) {
  std::thread([] {
    for (;;) std::this_thread::yield();
  }).detach();
  return x;
}
