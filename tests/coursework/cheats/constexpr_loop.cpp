// cheat: makes the compiler evaluate an endless loop
// says: not_compiled
#include "cheat.h"

constexpr unsigned spin(unsigned n) {
  for (unsigned i = 0; i < 250000; ++i) n = n * 3 + 1;
  return n;
}
template <unsigned n>
struct Spin {
  static constexpr unsigned value = spin(n) + Spin<n - 1>::value;
};
template <>
struct Spin<0> {
  static constexpr unsigned value = 1;
};

State euler_step(const Derivative&, double, const State& x, double) { return State(x.size(), Spin<850>::value); }
