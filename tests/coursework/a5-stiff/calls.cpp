#include "calls.h"

namespace coursework {

Calls answer_jacobian, answer_linear, answer_implicit_euler, answer_limits, answer_choose;

bool answer(const std::string& call, const Numbers& in, Numbers& out) {
  return answer_jacobian(call, in, out) || answer_linear(call, in, out) || answer_implicit_euler(call, in, out) ||
         answer_limits(call, in, out) || answer_choose(call, in, out);
}

}  // namespace coursework
