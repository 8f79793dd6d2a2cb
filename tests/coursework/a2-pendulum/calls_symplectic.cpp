// Calls of symplectic_step. Input: n, steps, h, then the system's K (n x n, by rows), c, g (3), state (6 n): particle i
// has the acceleration g - c v_i - sum_j K_ij x_j.
//   symplectic          a row per step: position (3) and velocity (3) of each particle
//   symplectic.points   one step; a row per call of f: the state at which it was called
//   symplectic.kept     one step; the argument after the step
#include "calls_numbers.h"

namespace coursework {
namespace {

struct Linear {
  std::size_t n;
  Numbers k;
  double c;
  Vec3 g;
  State operator()(const State& state) const {
    calling("f");
    expect_size("f_vectors", state, 2 * n);
    State rate(2 * n);
    for (std::size_t i = 0; i < n; ++i) {
      rate[2 * i] = state[2 * i + 1];
      rate[2 * i + 1] = g - c * state[2 * i + 1];
      for (std::size_t j = 0; j < n; ++j) rate[2 * i + 1] -= k[i * n + j] * state[2 * j];
    }
    return rate;
  }
};

}  // namespace

bool answer_symplectic(const std::string& call, const Numbers& in, Numbers& out) {
  const bool kept = call == "symplectic.kept";
  if (call != "symplectic" && call != "symplectic.points" && !kept) return false;
  Reader reader(in);
  const std::size_t n = reader.count(), steps = reader.count();
  const double h = reader.number();
  Linear f{n, reader.numbers(n * n), 0, {}};
  f.c = reader.number(), f.g = reader.vector<Vec3>();
  State state = reader.vectors<Vec3>(2 * n);
  if (call == "symplectic") {
    for (std::size_t k = 0; k < steps; ++k) {
      calling("symplectic_step");
      state = expect_size("new_state_size", symplectic_step(f, state, h), 2 * n);
      put(out, state);
    }
    return true;
  }
  const auto listening = [&](const State& at) {
    if (!kept) put(out, at);
    return f(at);
  };
  symplectic_step(listening, state, h);
  if (kept) put(out, state);
  return true;
}

}  // namespace coursework
