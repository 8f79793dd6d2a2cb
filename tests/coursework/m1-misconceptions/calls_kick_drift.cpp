// Calls of explicit_step, semi_implicit_step and kept.
//   kick_drift.step     omega, h, x, v              x, v after one step, for each of the two orders
//   kick_drift.energy   omega, h, x, v, then the predictions of two beliefs, which are shown but not used
//                       after every 100 of 1000 steps, the energy relative to the start, for each of the two orders
//   kick_drift.kept     omega, h, then x, v of each state   the result of kept() for each state
#include "beliefs.h"
#include "calls.h"
#include "numbers.h"

namespace coursework {
namespace {

double energy(double omega, const Swing& s) { return s.v * s.v + omega * omega * s.x * s.x; }

}  // namespace

bool answer_kick_drift(const std::string& call, const Numbers& in, Numbers& out) {
  if (call.compare(0, 11, "kick_drift.") != 0) return false;
  Reader reader(in);
  const double omega = reader.number(), h = reader.number();
  if (call == "kick_drift.kept") {
    for (std::size_t left = (in.size() - 2) / 2; left > 0; --left) {
      const double x = reader.number(), v = reader.number();
      calling("kept");
      out.push_back(kept(omega, {x, v}, h));
    }
    return true;
  }
  const double x = reader.number(), v = reader.number();
  const Swing start{x, v};
  if (call == "kick_drift.step") {
    calling("explicit_step");
    const Swing old = explicit_step(omega, start, h);
    calling("semi_implicit_step");
    const Swing fresh = semi_implicit_step(omega, start, h);
    out = {old.x, old.v, fresh.x, fresh.v};
    return true;
  }
  if (call != "kick_drift.energy") return false;
  Swing old = start, fresh = start;
  for (int step = 1; step <= 1000; ++step) {
    calling("explicit_step");
    old = explicit_step(omega, old, h);
    calling("semi_implicit_step");
    fresh = semi_implicit_step(omega, fresh, h);
    if (step % 100 != 0) continue;
    out.push_back(energy(omega, old) / energy(omega, start));
    out.push_back(energy(omega, fresh) / energy(omega, start));
  }
  return true;
}

}  // namespace coursework
