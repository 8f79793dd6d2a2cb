// Calls of rk4_step, rk4_energy_factor and rk4_largest_step.
//   rk4.step      omega, h, x, v      x, v after one step
//   rk4.energy    omega, h, x, v, then the prediction of a belief, which is shown but not used
//                 after every 100 of 1000 steps, the energy relative to the start
//   rk4.factor    values of h omega   the factor for each value
//   rk4.largest   values of omega     the largest step for each value
#include "beliefs.h"
#include "calls.h"

namespace coursework {

bool answer_rk4(const std::string& call, const Numbers& in, Numbers& out) {
  if (call == "rk4.factor" || call == "rk4.largest") {
    calling(call == "rk4.factor" ? "rk4_energy_factor" : "rk4_largest_step");
    for (const double one : in) out.push_back((call == "rk4.factor" ? rk4_energy_factor : rk4_largest_step)(one));
    return true;
  }
  if (call != "rk4.step" && call != "rk4.energy") return false;
  const double omega = in.at(0), h = in.at(1);
  Swing now{in.at(2), in.at(3)};
  const auto energy = [&] { return now.v * now.v + omega * omega * now.x * now.x; };
  const double start = energy();
  for (int step = 1; step <= (call == "rk4.step" ? 1 : 1000); ++step) {
    calling("rk4_step");
    now = rk4_step(omega, now, h);
    if (step % 100 == 0) out.push_back(energy() / start);
  }
  if (call == "rk4.step") out = {now.x, now.v};
  return true;
}

}  // namespace coursework
