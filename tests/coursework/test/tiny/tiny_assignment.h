// An assignment for the grader's own tests; it is in no table.
#pragma once

#include "tests/coursework/grader/assignment.h"

namespace coursework {

const Assignment& tiny();

}  // namespace coursework
