// Calls of pendulum_derivative. All begin with g (3), drag, mass, stiffness, rest; a state is 12 numbers.
//   pendulum         state             a row per particle: rate of position (3), rate of velocity (3)
//   pendulum.twice   state A, state B  rows: the derivative at A, at B, and again at A; then the argument A afterwards
//   pendulum.swing   steps, h, state   a row per step of RK4: position (3) and velocity (3) of particle 1
#include "calls_numbers.h"

namespace coursework {
namespace {

State moved(const State& state, double h, const State& rate) {
  State there = state;
  for (std::size_t i = 0; i < there.size(); ++i) there[i] += h * rate[i];
  return there;
}

/// The grader's RK4 step with the student's derivative.
State rk4_step(const Pendulum& pendulum, const State& state, double h) {
  const auto f = [&](const State& at) {
    calling("pendulum_derivative");
    return expect_size("derivative_size", pendulum_derivative(pendulum, at), state.size());
  };
  const State k1 = f(state), k2 = f(moved(state, h / 2, k1)), k3 = f(moved(state, h / 2, k2)),
              k4 = f(moved(state, h, k3));
  return moved(moved(moved(moved(state, h / 6, k1), h / 3, k2), h / 3, k3), h / 6, k4);
}

}  // namespace

bool answer_pendulum(const std::string& call, const Numbers& in, Numbers& out) {
  if (call.compare(0, 8, "pendulum") != 0) return false;
  Reader reader(in);
  Pendulum p;
  p.gravity = reader.vector<Vec3>(), p.drag = reader.number(), p.mass = reader.number();
  p.stiffness = reader.number(), p.rest = reader.number();
  if (call == "pendulum") return put(out, pendulum_derivative(p, reader.vectors<Vec3>(4))), true;
  if (call == "pendulum.twice") {
    const State a = reader.vectors<Vec3>(4), b = reader.vectors<Vec3>(4);
    for (const State& state : {std::cref(a), std::cref(b), std::cref(a)}) put(out, pendulum_derivative(p, state));
    put(out, a);
    return true;
  }
  if (call == "pendulum.swing") {
    const std::size_t steps = reader.count();
    const double h = reader.number();
    State state = reader.vectors<Vec3>(4);
    for (std::size_t k = 0; k < steps; ++k) {
      state = rk4_step(p, state, h);
      put(out, state[2]), put(out, state[3]);
    }
    return true;
  }
  return false;
}

}  // namespace coursework
