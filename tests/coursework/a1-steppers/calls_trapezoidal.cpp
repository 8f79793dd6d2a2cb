// Calls of trapezoidal_step.
#include "calls_steppers.h"

namespace coursework {

bool answer_trapezoidal(const std::string& call, const Numbers& in, Numbers& out) {
  return answer_stepper("trapezoidal", trapezoidal_step, call, in, out);
}

}  // namespace coursework
