// The student's pendulum and chain: the same class, with two particles and with four.
#ifndef STUDENT_HEADER  // the grader says what it found (build.cpp); in the hand-out the starter's names hold
#define STUDENT_HEADER "pendulumSystem.h"
#define STUDENT_CLASS PendulumSystem
#define ANSWER answer_pendulum
#endif
#include STUDENT_HEADER
#ifdef STUDENT_CHAIN_HEADER
#include STUDENT_CHAIN_HEADER
#else
#define STUDENT_CHAIN STUDENT_CLASS
#endif

#include "calls.h"
#include "probe/roles.h"

namespace coursework {

bool ANSWER(const std::string& call, const Numbers& in, Numbers& out) {
  return probe::pendulum<STUDENT_CLASS, STUDENT_CHAIN>(call, in, out);
}

}  // namespace coursework
