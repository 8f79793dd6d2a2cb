// cheat: allocates 100 GB
// says: out_of_memory
#include <vector>

#include "cheat.h"

State euler_step(const Derivative&, double, const State& x, double) {
  std::vector<char> block(100ul << 30, 1);
  return State(x.size(), block[block.size() / 2]);
}
