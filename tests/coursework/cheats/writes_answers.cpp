// cheat: writes answers of its own to the answers' descriptor, in addition to those of the test
// says: no_token differs size
#include <unistd.h>
#include <cstring>

#include "cheat.h"

State euler_step(const Derivative&, double, const State& x, double) {
  const char* line = "answer 2 0x1p+0 0x0p+0\n";
  if (write(3, line, std::strlen(line)) < 0) return x;
  return x;
}
