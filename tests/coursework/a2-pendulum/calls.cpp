// Dispatches the assignment's calls to its parts.
#include "calls.h"

namespace coursework {

bool answer_gravity_drag(const std::string& call, const Numbers& in, Numbers& out);
bool answer_spring(const std::string& call, const Numbers& in, Numbers& out);
bool answer_pendulum(const std::string& call, const Numbers& in, Numbers& out);
bool answer_chain(const std::string& call, const Numbers& in, Numbers& out);
bool answer_symplectic(const std::string& call, const Numbers& in, Numbers& out);

bool answer(const std::string& call, const Numbers& in, Numbers& out) {
  return answer_gravity_drag(call, in, out) || answer_spring(call, in, out) || answer_pendulum(call, in, out) ||
         answer_chain(call, in, out) || answer_symplectic(call, in, out);
}

}  // namespace coursework
