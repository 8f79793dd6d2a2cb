#include "calls.h"

namespace coursework {

Calls answer_pass, answer_step, answer_rate, answer_leftover, answer_averaging;

bool answer(const std::string& call, const Numbers& in, Numbers& out) {
  return answer_pass(call, in, out) || answer_step(call, in, out) || answer_rate(call, in, out) ||
         answer_leftover(call, in, out) || answer_averaging(call, in, out);
}

}  // namespace coursework
