// What a hand-out says of itself: how it is built, what its `check` does, what counts.
#pragma once

#include <string>

#include "tests/coursework/check/cases_file.h"
#include "tests/coursework/grader/assignment.h"

namespace coursework {

/// CMakeLists.txt for an assignment of one file per part. A whole program brings its own in its starter.
std::string cmake_lists(const Assignment& assignment);

/// README.md for an assignment of one file per part.
std::string readme(const Assignment& assignment, const PublicTests& tests);
/// README.md for a whole program.
std::string readme_of_whole(const Assignment& assignment, const PublicTests& tests);

}  // namespace coursework
