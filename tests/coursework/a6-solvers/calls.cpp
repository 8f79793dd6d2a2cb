// Dispatches the assignment's calls to its parts.
#include "calls.h"

namespace coursework {

bool answer_pass(const std::string& call, const Numbers& in, Numbers& out);
bool answer_step(const std::string& call, const Numbers& in, Numbers& out);
bool answer_rate(const std::string& call, const Numbers& in, Numbers& out);
bool answer_leftover(const std::string& call, const Numbers& in, Numbers& out);
bool answer_averaging(const std::string& call, const Numbers& in, Numbers& out);

bool answer(const std::string& call, const Numbers& in, Numbers& out) {
  return answer_pass(call, in, out) || answer_step(call, in, out) || answer_rate(call, in, out) ||
         answer_leftover(call, in, out) || answer_averaging(call, in, out);
}

}  // namespace coursework
