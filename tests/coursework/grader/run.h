// Runs calls of a student's program in one process, and returns the answers.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "tests/coursework/check/case.h"
#include "tests/coursework/grader/sandbox.h"

namespace coursework {

/// CPU time (s) that any code may use for the calls of one test. The slowest test takes 0.06 s with the classic
/// solution. With the slowest correct code seen so far, whose evalF takes 5 ms, it takes half of this limit.
constexpr double least_cpu = 30;
/// Code may use this multiple of the official solution's CPU time for the same calls on the same machine.
constexpr double times_reference = 20;

/// Limits of a test whose calls take the official solution `reference` s of CPU time. Only CPU time decides: the
/// wall-clock limit is sixty times larger, for a machine with sixty busy programs per processor. The idle limit stops
/// programs that wait.
Limits limits_for(double reference, double least = least_cpu);

/// Returns one answer per case, whatever the program does. `captured` receives the beginning of its output. The answers
/// must end with the token that the program was sent.
std::vector<Answer> run_calls(const Sandbox& sandbox, const std::filesystem::path& program,
                              const std::vector<Case>& cases, const Limits& limits = limits_for(0),
                              double* cpu = nullptr, std::string* captured = nullptr);

/// The text of an exception that may be shown: the whole text if it occurs in one of the student's files or comes from
/// the standard library (numbers of up to six digits may differ), otherwise nothing. This prevents leaks of our code
/// and texts, and of anything else that a program can read.
std::string shown_exception(const std::string& text, const std::map<std::string, std::string>& files);

/// Interprets the lines from descriptor 3 and the end of the process for each of `count` calls. If any line differs
/// from the format of tests/coursework/check/child_main.cpp, all answers are How::no_token.
std::vector<Answer> answers_of(const End& end, const std::string& token, std::size_t count, const Limits& limits);

}  // namespace coursework
