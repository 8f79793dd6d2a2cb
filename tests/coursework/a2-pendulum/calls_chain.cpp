// Calls of chain_derivative. All begin with n, g (3), drag, mass (n), stiffness (n - 1), rest (n - 1). A state has 6 n
// numbers.
//   chain         state             a row per particle: rate of position (3), rate of velocity (3)
//   chain.twice   state A, state B  rows: the derivative at A, at B, and again at A; then the argument A afterwards
#include "calls_numbers.h"

namespace coursework {

bool answer_chain(const std::string& call, const Numbers& in, Numbers& out) {
  if (call != "chain" && call != "chain.twice") return false;
  Reader reader(in);
  const std::size_t n = reader.count();
  Chain c;
  c.gravity = reader.vector<Vec3>(), c.drag = reader.number(), c.mass = reader.numbers(n);
  c.stiffness = reader.numbers(n - 1), c.rest = reader.numbers(n - 1);
  const State a = reader.vectors<Vec3>(2 * n);
  put(out, chain_derivative(c, a));
  if (call == "chain.twice") {
    put(out, chain_derivative(c, reader.vectors<Vec3>(2 * n)));
    put(out, chain_derivative(c, a)), put(out, a);
  }
  return true;
}

}  // namespace coursework
