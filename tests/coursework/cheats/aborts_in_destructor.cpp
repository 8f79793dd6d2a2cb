// cheat: crashes when a local object is destroyed
// says: crashed
#include <cstdlib>

#include "cheat.h"

struct Mine {
  ~Mine() { std::abort(); }
};

State euler_step(const Derivative&, double, const State& x, double) {
  Mine mine;
  return x;
}
