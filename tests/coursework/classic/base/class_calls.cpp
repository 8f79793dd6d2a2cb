// Calls of one of the student's classes in every role that it could have; the grader builds this file once for each
// class.
#include STUDENT_HEADER
#ifdef PARTICLE_HEADER
#include PARTICLE_HEADER  // the class's header may contain only a declaration of ParticleSystem
#endif
#ifdef STUDENT_CHAIN_HEADER
#include STUDENT_CHAIN_HEADER
#else
#define STUDENT_CHAIN STUDENT_CLASS
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
  return call == "base" ? probe::base_works(out) : probe::path<STUDENT_CLASS>(call, in, out);
#elif defined FIELD
  return probe::simple<STUDENT_CLASS>(call, in, out);
#else
  return probe::simple<STUDENT_CLASS>(call, in, out) || probe::cloth<STUDENT_CLASS>(call, in, out) ||
         probe::pendulum<STUDENT_CLASS, STUDENT_CHAIN>(call, in, out);
#endif
}

}  // namespace coursework
