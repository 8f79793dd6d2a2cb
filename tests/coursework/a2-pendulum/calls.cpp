#include "calls.h"

namespace coursework {

Calls answer_gravity_drag, answer_spring, answer_pendulum, answer_chain, answer_symplectic;

bool answer(const std::string& call, const Numbers& in, Numbers& out) {
  return answer_gravity_drag(call, in, out) || answer_spring(call, in, out) || answer_pendulum(call, in, out) ||
         answer_chain(call, in, out) || answer_symplectic(call, in, out);
}

}  // namespace coursework
