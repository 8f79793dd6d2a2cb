// cheat: jumps over the rest of the test
// says: differs crashed no_token
#include <csetjmp>
#include <csignal>

#include "cheat.h"

State euler_step(const Derivative&, double, const State& x, double) {
  static std::jmp_buf place;
  if (setjmp(place) == 0) {
    std::signal(SIGSEGV, [](int) { std::longjmp(place, 1); });
    std::raise(SIGSEGV);
  }
  return x;
}
