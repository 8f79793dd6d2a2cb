// A compiler's output in plain words.
#pragma once

#include <string>

#include "tests/coursework/grader/submission.h"

namespace coursework {

/// The first error that concerns the student's `file` (its bare name): where and what. `said` is what g++ or clang++
/// wrote, in English.
Remark first_error(const std::string& file, const std::string& said);

}  // namespace coursework
