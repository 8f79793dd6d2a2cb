// Calls of averaging_pass, averaging_step and stiffness_of.
//   averaging.pass        net, x (3 n)                              three numbers for each particle
//   averaging.state       net, x (3 n), v (3 n), h, passes, steps   position and velocity of each particle at the end
//   averaging.stiffness   mass, h, passes of each case              the stiffness for each case
//   averaging.rest        a chain, h                                with 1, 2, 4, ... 32 passes a step: the stretch of
//                                                                   the chain at rest, in percent of the exact stretch
#include "calls_read.h"

namespace coursework {

bool answer_averaging(const std::string& call, const Numbers& in, Numbers& out) {
  Reader reader(in);
  const auto step = [](const Net& net, double h, int passes) {
    return [&net, h, passes](const State& now) { return averaging_step(net, now, h, passes); };
  };
  if (call == "averaging.pass") {
    const Net net = read_net(reader);
    const std::vector<Vec3> x = reader.vectors<Vec3>(net.held.size());
    put(out, of_all(x, [&] { return averaging_pass(net, x); }));
  } else if (call == "averaging.state") {
    const Net net = read_net(reader);
    State state = read_state<State>(reader, net.held.size());
    const double h = reader.number();
    const int passes = reader.integer();
    for (int left = reader.integer(); left > 0; --left) advance(state, "averaging_step", step(net, h, passes));
    put_state(out, state);
  } else if (call == "averaging.stiffness") {
    for (std::size_t rows = in.size() / 3; rows > 0; --rows) {
      const double mass = reader.number(), h = reader.number();
      out.push_back(stiffness_of(mass, h, reader.integer()));
    }
  } else if (call == "averaging.rest") {
    const Net chain = read_chain(reader);
    const double h = reader.number();
    for (int passes = 1; passes <= 32; passes *= 2)
      out.push_back(stretch_at_rest(chain, 2000, "averaging_step", step(chain, h, passes)));
  } else {
    return false;
  }
  return true;
}

}  // namespace coursework
