#include "calls.h"

namespace coursework {

bool answer_closest(const std::string& call, const Numbers& in, Numbers& out);
bool answer_position(const std::string& call, const Numbers& in, Numbers& out);
bool answer_velocity(const std::string& call, const Numbers& in, Numbers& out);
bool answer_step(const std::string& call, const Numbers& in, Numbers& out);
bool answer_cloth(const std::string& call, const Numbers& in, Numbers& out);

bool answer(const std::string& call, const Numbers& in, Numbers& out) {
  return answer_closest(call, in, out) || answer_position(call, in, out) || answer_velocity(call, in, out) ||
         answer_step(call, in, out) || answer_cloth(call, in, out);
}

}  // namespace coursework
