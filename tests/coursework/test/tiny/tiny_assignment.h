// An assignment for the grader's own tests; it is not in the table of assignments.
#pragma once

#include "tests/coursework/grader/assignment.h"

namespace coursework {

const Assignment& tiny();

}  // namespace coursework
