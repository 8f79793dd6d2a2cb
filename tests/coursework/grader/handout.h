// The hand-out: the lecture, the starter, and `check` with the public tests.
#pragma once

#include <filesystem>

#include "tests/coursework/check/cases_file.h"
#include "tests/coursework/grader/assignment.h"

namespace coursework {

/// The hand-out's cases of all tests, with their public seeds. A test whose raw numbers are reduced has no cases,
/// because only the grader has the reduction.
PublicTests public_tests(const Assignment& assignment);

/// Creates the folder and writes handout.md, the starter, check/, CMakeLists.txt and README.md into it. Omits the
/// solution, the styles, the mistakes and the tests' code. Throws InputError if a file cannot be written, and
/// std::runtime_error if a file of the assignment is missing.
void write_handout(const Assignment& assignment, const std::filesystem::path& folder);

/// Writes the hand-out in Python, with check.py instead of the program `check`. Throws InputError if the assignment is
/// in C++ only.
void write_python_handout(const Assignment& assignment, const std::filesystem::path& folder);

}  // namespace coursework
