// Students' parts as engines in crosscheck's charts, for assignments with a calls_engine.cpp.
#pragma once

#include <filesystem>
#include <string>

#include "tests/coursework/grader/assignment.h"
#include "tests/coursework/grader/lane.h"

namespace coursework {

bool has_engine(const Assignment& assignment);

/// Leaves FOLDER/your-PART, a program of the engine protocol that runs the student's in this lane.
void keep_engine(const std::filesystem::path& program, const std::string& part, const Lane& lane,
                 const std::filesystem::path& folder);

}  // namespace coursework
