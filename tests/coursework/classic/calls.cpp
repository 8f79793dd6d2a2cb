// The hand-out's calls, all parts in one program. In the grader each class has a program of its own
// (base/class_calls.cpp).
#include "calls.h"

#include "looks.h"

namespace coursework {

bool answer_moving(const std::string& call, const Numbers& in, Numbers& out);  // motion_calls.cpp
bool answer_cloth(const std::string& call, const Numbers& in, Numbers& out);   // calls_cloth.cpp

bool answer(const std::string& call, const Numbers& in, Numbers& out) {
  return answer_moving(call, in, out) || answer_cloth(call, in, out);
}

Found compared(const Case& what, const Numbers& answered) { return classic::features(what, answered); }

std::string asked_and_came(const Texts& own, const Case& what, const Numbers& answered) {
  return classic::shown(own, what, answered);
}

}  // namespace coursework
