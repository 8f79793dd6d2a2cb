// Dispatches the assignment's calls to its parts.
#include "calls.h"

namespace coursework {

bool answer_euler(const std::string& call, const Numbers& in, Numbers& out);
bool answer_trapezoidal(const std::string& call, const Numbers& in, Numbers& out);
bool answer_rk4(const std::string& call, const Numbers& in, Numbers& out);
bool answer_engine(const std::string& call, const Numbers& in, Numbers& out);

bool answer(const std::string& call, const Numbers& in, Numbers& out) {
  return answer_euler(call, in, out) || answer_trapezoidal(call, in, out) || answer_rk4(call, in, out) ||
         answer_engine(call, in, out);
}

}  // namespace coursework
