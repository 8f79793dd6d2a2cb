// Calls of euler_step.
#include "calls_steppers.h"

namespace coursework {

bool answer_euler(const std::string& call, const Numbers& in, Numbers& out) {
  return answer_stepper("euler", euler_step, call, in, out);
}

}  // namespace coursework
