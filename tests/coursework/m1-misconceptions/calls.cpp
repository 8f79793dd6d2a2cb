#include "calls.h"

namespace coursework {

Calls answer_kick_drift, answer_verlet, answer_sag, answer_iterations, answer_rk4;

bool answer(const std::string& call, const Numbers& in, Numbers& out) {
  return answer_kick_drift(call, in, out) || answer_verlet(call, in, out) || answer_sag(call, in, out) ||
         answer_iterations(call, in, out) || answer_rk4(call, in, out);
}

}  // namespace coursework
