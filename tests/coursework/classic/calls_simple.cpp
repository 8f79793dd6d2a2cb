// The student's simple system.
#ifndef STUDENT_HEADER  // the grader says what it found (build.cpp); in the hand-out the starter's names hold
#define STUDENT_HEADER "simpleSystem.h"
#define STUDENT_CLASS SimpleSystem
#define ANSWER answer_simple
#endif
#include STUDENT_HEADER

#include "calls.h"
#include "probe/roles.h"

namespace coursework {

bool ANSWER(const std::string& call, const Numbers& in, Numbers& out) {
  return probe::simple<STUDENT_CLASS>(call, in, out);
}

}  // namespace coursework
