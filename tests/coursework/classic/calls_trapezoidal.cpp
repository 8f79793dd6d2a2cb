// The student's trapezoidal rule; STUDENT_HEADER and STUDENT_CLASS come from the adapter (build.cpp).
#include STUDENT_HEADER
#ifdef PARTICLE_HEADER
#include PARTICLE_HEADER  // which the other may only announce
#endif

#include "calls.h"
#include "probe/stepper.h"

bool coursework::answer(const std::string& call, const Numbers& in, Numbers& out) {
  return call == "path" && probe::path<STUDENT_CLASS>(in, out);
}
