#include "calls.h"

namespace coursework {

Calls answer_closest, answer_position, answer_velocity, answer_step, answer_cloth;

bool answer(const std::string& call, const Numbers& in, Numbers& out) {
  return answer_closest(call, in, out) || answer_position(call, in, out) || answer_velocity(call, in, out) ||
         answer_step(call, in, out) || answer_cloth(call, in, out);
}

}  // namespace coursework
