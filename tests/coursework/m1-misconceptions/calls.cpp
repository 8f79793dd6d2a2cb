#include "calls.h"

namespace coursework {

bool answer_kick_drift(const std::string& call, const Numbers& in, Numbers& out);
bool answer_verlet(const std::string& call, const Numbers& in, Numbers& out);
bool answer_sag(const std::string& call, const Numbers& in, Numbers& out);
bool answer_iterations(const std::string& call, const Numbers& in, Numbers& out);
bool answer_rk4(const std::string& call, const Numbers& in, Numbers& out);

bool answer(const std::string& call, const Numbers& in, Numbers& out) {
  return answer_kick_drift(call, in, out) || answer_verlet(call, in, out) || answer_sag(call, in, out) ||
         answer_iterations(call, in, out) || answer_rk4(call, in, out);
}

}  // namespace coursework
