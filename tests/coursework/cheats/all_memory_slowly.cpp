// cheat: allocates memory bit by bit, and keeps it
// says: out_of_memory out_of_time as_ungraded
#include <vector>

#include "cheat.h"

State euler_step(const Derivative&, double, const State& x, double) {
  static std::vector<std::vector<char>> kept;
  for (;;) kept.emplace_back(10 << 20, 1);
  return x;
}
