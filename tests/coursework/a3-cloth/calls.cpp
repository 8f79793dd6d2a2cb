#include "calls.h"

namespace coursework {

bool answer_grid(const std::string& call, const Numbers& in, Numbers& out);
bool answer_springs(const std::string& call, const Numbers& in, Numbers& out);
bool answer_forces(const std::string& call, const Numbers& in, Numbers& out);
bool answer_wind(const std::string& call, const Numbers& in, Numbers& out);
bool answer_derivative(const std::string& call, const Numbers& in, Numbers& out);

bool answer(const std::string& call, const Numbers& in, Numbers& out) {
  return answer_grid(call, in, out) || answer_springs(call, in, out) || answer_forces(call, in, out) ||
         answer_wind(call, in, out) || answer_derivative(call, in, out);
}

}  // namespace coursework
