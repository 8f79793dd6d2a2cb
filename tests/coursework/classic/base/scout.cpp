// A class of the student's that may be meant by several parts: it is asked what each of them asks.
#include STUDENT_HEADER
#ifdef PARTICLE_HEADER
#include PARTICLE_HEADER
#endif

#include "calls.h"
#ifdef STEPPER
#include "probe/stepper.h"
#else
#include "probe/roles.h"
#endif

namespace coursework {

bool answer(const std::string& call, const Numbers& in, Numbers& out) {
#ifdef STEPPER
  return probe::path<STUDENT_CLASS>(in, out);
#else
  return probe::simple<STUDENT_CLASS>(call, in, out) || probe::cloth<STUDENT_CLASS>(call, in, out) ||
         probe::pendulum<STUDENT_CLASS, STUDENT_CLASS>(call, in, out);
#endif
}

}  // namespace coursework
