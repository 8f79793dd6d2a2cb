// cheat: crashes after the test, when static objects are destroyed
// says: differs
#include <cstdlib>

#include "cheat.h"

struct Mine {
  ~Mine() { std::abort(); }
};
Mine mine;

State euler_step(const Derivative&, double, const State& x, double) { return x; }
