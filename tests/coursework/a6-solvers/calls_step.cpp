// Calls of weights and implicit_step.
//   step.weights   rho, passes                                       the weight of each pass
//   step.state     net, x (3 n), v (3 n), h, rho, passes, steps      position and velocity of each particle at the end
//   step.errors    net, x (3 n), v (3 n), h, rho, exact step (3 n)   with 1, 2, 4, ... 128 passes: the largest distance
//                                                                    from the exact step
//   step.rest      a chain, h, rho                                   with 1, 2, 4, ... 32 passes a step: the stretch of
//                                                                    the chain at rest, in percent of the exact stretch
//   step.net       particles along a side, side, mass, stiffness, gravity, h, rho, passes, steps
//                                                                    position of the middle particle after each step
#include <algorithm>

#include "calls_read.h"

namespace coursework {
namespace {

double farthest(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, length(a[i] - b[i]));
  return most;
}

}  // namespace

bool answer_step(const std::string& call, const Numbers& in, Numbers& out) {
  Reader reader(in);
  const auto step = [](const Net& net, double h, double rho, int passes) {
    return [&net, h, rho, passes](const State& now) { return implicit_step(net, now, h, passes, rho); };
  };
  if (call == "step.weights") {
    const double rho = reader.number();
    out = weights(reader.integer(), rho);
  } else if (call == "step.state" || call == "step.errors") {
    const Net net = read_net(reader);
    State state = read_state<State>(reader, net.held.size());
    const double h = reader.number(), rho = reader.number();
    if (call == "step.state") {
      const int passes = reader.integer();
      for (int left = reader.integer(); left > 0; --left) advance(state, "implicit_step", step(net, h, rho, passes));
      put_state(out, state);
      return true;
    }
    const std::vector<Vec3> exact = reader.vectors<Vec3>(net.held.size());
    for (int passes = 1; passes <= 128; passes *= 2) {
      State after = state;
      advance(after, "implicit_step", step(net, h, rho, passes));
      out.push_back(farthest(after.x, exact));
    }
  } else if (call == "step.rest") {
    const Net chain = read_chain(reader);
    const double h = reader.number(), rho = reader.number();
    for (int passes = 1; passes <= 32; passes *= 2)
      out.push_back(stretch_at_rest(chain, 2000, "implicit_step", step(chain, h, rho, passes)));
  } else if (call == "step.net") {
    const int side = reader.integer();
    State state = square_state(side, reader.number());
    const double mass = reader.number(), stiffness = reader.number();
    const Net net = square_net(side, mass, stiffness, {0, -reader.number(), 0}, state);
    const double h = reader.number(), rho = reader.number();
    const int passes = reader.integer();
    for (int left = reader.integer(); left > 0; --left) {
      advance(state, "implicit_step", step(net, h, rho, passes));
      put(out, state.x[state.x.size() / 2]);
    }
  } else {
    return false;
  }
  return true;
}

}  // namespace coursework
