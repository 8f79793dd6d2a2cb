#include "calls.h"

namespace coursework {

Calls answer_grid, answer_springs, answer_forces, answer_wind, answer_derivative;

bool answer(const std::string& call, const Numbers& in, Numbers& out) {
  return answer_grid(call, in, out) || answer_springs(call, in, out) || answer_forces(call, in, out) ||
         answer_wind(call, in, out) || answer_derivative(call, in, out);
}

}  // namespace coursework
