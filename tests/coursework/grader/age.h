// Whether the grader was built from what it reads.
#pragma once

#include <filesystem>
#include <string>

#include "tests/coursework/grader/assignment.h"

namespace coursework {

/// A file of the assignment's folder, of check/ or of grader/ that was changed after `program` was built, the newest
/// one; empty: there is none, or it cannot be told. What is compiled into a submission's programs is read anew each
/// time, the tests and what is said of them are not.
std::filesystem::path newer_than(const std::filesystem::path& program, const Assignment& assignment);

/// Says so on standard error.
void warn_if_older(const Assignment& assignment);

}  // namespace coursework
