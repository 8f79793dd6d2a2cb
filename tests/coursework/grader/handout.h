// The hand-out: the lecture, the starter, and `check` with the public tests.
#pragma once

#include <filesystem>
#include <string>

#include "tests/coursework/check/cases_file.h"
#include "tests/coursework/grader/assignment.h"

namespace coursework {

/// The hand-out's cases: every test under its public seed. A test whose raw numbers are reduced first has none, because
/// the reduction stays with the grader.
PublicTests public_tests(const Assignment& assignment);

/// Creates the folder and writes handout.md, the starter, check/, CMakeLists.txt and README.md into it; nothing of the
/// solution, the styles, the mistakes and the tests' own code. Throws InputError if a file cannot be written, and
/// std::runtime_error if the assignment lacks one.
void write_handout(const Assignment& assignment, const std::filesystem::path& folder);

/// Writes the hand-out in Python, with check.py in place of the program `check`. Throws InputError if the assignment is
/// in C++ only.
void write_python_handout(const Assignment& assignment, const std::filesystem::path& folder);

}  // namespace coursework
