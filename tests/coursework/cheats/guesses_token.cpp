// cheat: writes answers and a guessed token, and exits
// says: no_token
#include <unistd.h>
#include <string>

#include "cheat.h"

State euler_step(const Derivative&, double, const State& x, double) {
  std::string text;
  for (int i = 0; i < 4; ++i) text += "answer 2 0x1p+0 0x0p+0\n";
  text += "token 00000000000000000000000000000000\npassed\n";
  if (write(3, text.data(), text.size()) < 0) return x;
  _exit(0);
}
