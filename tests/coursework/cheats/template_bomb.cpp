// cheat: makes the compiler instantiate 2^1000 templates
// says: not_compiled
#include "cheat.h"

template <int depth, int path>
struct Bomb {
  static constexpr int size = Bomb<depth - 1, 2 * path>::size + Bomb<depth - 1, 2 * path + 1>::size;
};
template <int path>
struct Bomb<0, path> {
  static constexpr int size = 1;
};

State euler_step(const Derivative&, double, const State& x, double) { return State(x.size(), Bomb<30, 1>::size); }
