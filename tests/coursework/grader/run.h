// One process of a student's program: reads calls, returns answers.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "tests/coursework/check/case.h"
#include "tests/coursework/grader/sandbox.h"

namespace coursework {

/// CPU time (s) that any code may use for the calls of one test: hundreds of times the time of the slowest test for the
/// classic solution (0.06 s), and twice its time with an evalF of 5 ms, the slowest correct one seen so far.
constexpr double least_cpu = 30;
/// Code may use this multiple of the official solution's CPU time for the same calls on the same machine.
constexpr double times_reference = 20;

/// Limits of a test whose calls cost the official solution `reference` s. Only CPU time decides: the wall-clock limit
/// is sixty times larger, for a machine with sixty busy programs per processor, and the idle limit stops programs that
/// wait.
Limits limits_for(double reference, double least = least_cpu);

/// One answer per case, whatever the program does; `captured`: the beginning of its output. `token` must end the
/// answers.
std::vector<Answer> run_calls(const Sandbox& sandbox, const std::filesystem::path& program,
                              const std::vector<Case>& cases, const Limits& limits = limits_for(0),
                              double* cpu = nullptr, std::string* captured = nullptr);

/// The part of an exception's text that may be shown: all of it, if it occurs in one of the student's files or comes
/// from the standard library, except for numbers of up to six digits; otherwise nothing. This prevents leaks of our
/// code and texts, and of anything else that a program can read.
std::string shown_exception(const std::string& text, const std::map<std::string, std::string>& files);

/// Interprets the lines on descriptor 3 and the end of the process for each of `count` calls. Lines that differ from
/// the format of tests/coursework/check/child_main.cpp make all answers How::no_token.
std::vector<Answer> answers_of(const End& end, const std::string& token, std::size_t count, const Limits& limits);

}  // namespace coursework
