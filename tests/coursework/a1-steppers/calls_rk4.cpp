// Calls of rk4_step.
#include "calls_steppers.h"

namespace coursework {

bool answer_rk4(const std::string& call, const Numbers& in, Numbers& out) {
  return answer_stepper("rk4", rk4_step, call, in, out);
}

}  // namespace coursework
