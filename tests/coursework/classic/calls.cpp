// The hand-out's calls, all parts in one program. In the grader each part has a program of its own.
#include "calls.h"

#include "looks.h"

namespace coursework {

bool answer_euler(const std::string& call, const Numbers& in, Numbers& out);
bool answer_trapezoidal(const std::string& call, const Numbers& in, Numbers& out);
bool answer_simple(const std::string& call, const Numbers& in, Numbers& out);
bool answer_pendulum(const std::string& call, const Numbers& in, Numbers& out);
bool answer_cloth(const std::string& call, const Numbers& in, Numbers& out);
bool answer_motion(const std::string& call, const Numbers& in, Numbers& out);

bool answer(const std::string& call, const Numbers& in, Numbers& out) {
  return answer_euler(call, in, out) || answer_trapezoidal(call, in, out) || answer_simple(call, in, out) ||
         answer_motion(call, in, out) || answer_pendulum(call, in, out) || answer_cloth(call, in, out);
}

Found compared(const Case& what, const Numbers& answered) { return classic::features(what, answered); }

std::string asked_and_came(const Texts& own, const Case& what, const Numbers& answered) {
  return classic::shown(own, what, answered);
}

}  // namespace coursework
