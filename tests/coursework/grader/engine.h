// Makes students' parts available as engines in crosscheck's charts, for assignments with a file calls_engine.cpp.
#pragma once

#include <filesystem>
#include <string>

#include "tests/coursework/grader/assignment.h"
#include "tests/coursework/grader/sandbox.h"

namespace coursework {

bool has_engine(const Assignment& assignment);

/// Writes FOLDER/your-PART, a script that follows the engine protocol and runs the student's program in this sandbox.
void keep_engine(const std::filesystem::path& program, const std::string& part, const Sandbox& sandbox,
                 const std::filesystem::path& folder);

}  // namespace coursework
