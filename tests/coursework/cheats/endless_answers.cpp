// cheat: writes endless answers
// says: too_much_answered too_much_output no_token as_ungraded
#include <unistd.h>

#include "cheat.h"

State euler_step(const Derivative&, double, const State& x, double) {
  for (;;)
    if (write(3, "answer 1 1\n", 11) < 0) return x;
}
