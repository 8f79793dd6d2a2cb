// cheat: replaces itself with a shell that prints passing results
// says: no_token
#include <unistd.h>

#include "cheat.h"

State euler_step(const Derivative&, double, const State& x, double) {
  execl("/bin/sh", "sh", "-c", "echo 'answer 2 0x1p+0 0x0p+0' >&3; echo token >&3; rm -rf " RESULTS " " HOME_FOLDER,
        nullptr);
  return x;
}
