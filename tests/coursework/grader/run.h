// One process of a student's program: calls in, answers out.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/coursework/check/case.h"
#include "tests/coursework/grader/sandbox.h"

namespace coursework {

/// An answer per case, whatever the program does. `token` is what it must say at the end.
std::vector<Answer> run_calls(const Sandbox& sandbox, const std::filesystem::path& program,
                              const std::vector<Case>& cases, const Limits& limits = {});

/// What the lines on descriptor 3 and the end of the process mean for each of `count` calls. Lines that are not of the
/// form that tests/coursework/check/child_main.cpp writes make all of them How::no_token.
std::vector<Answer> answers_of(const End& end, const std::string& token, std::size_t count, const Limits& limits);

}  // namespace coursework
