// cheat: defines a weak answer(), in case the linker prefers it
// says: differs
#include <string>
#include <vector>

#include "cheat.h"

namespace coursework {
__attribute__((weak)) bool answer(const std::string&, const std::vector<double>&, std::vector<double>& out) {
  out.assign(2, 0);
  return true;
}
}  // namespace coursework

State euler_step(const Derivative&, double, const State& x, double) { return x; }
