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
#include "probe/ask.h"

namespace coursework {

/// A call of probe/forces.h with "pendulum." or "chain." before it; in the count of particles and the seed; out is
/// what evalF answered.
bool ANSWER(const std::string& call, const Numbers& in, Numbers& out) {
  const int count = static_cast<int>(in[0]);
  const auto seed = static_cast<std::uint64_t>(in[1]);
  if (call.rfind("pendulum.", 0) == 0)
    return probe::answered(probe::ready<STUDENT_CLASS>(count, true), seed, call.substr(9), out);
  if (call.rfind("chain.", 0) == 0) {
#ifndef STUDENT_CHAIN_HEADER
    // one of another size was asked before: nothing of it may be kept
    auto& other = probe::ready<STUDENT_CLASS>(2, true);
    probe::evaluate(other, probe::state_of(other));
#endif
    return probe::answered(probe::ready<STUDENT_CHAIN>(count, true), seed, call.substr(6), out);
  }
  return false;
}

}  // namespace coursework
