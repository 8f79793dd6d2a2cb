// One process of a student's program: calls in, answers out.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "tests/coursework/check/case.h"
#include "tests/coursework/grader/sandbox.h"

namespace coursework {

/// s of processor time that any code may take for the calls of one test: hundreds of times what the slowest of the
/// classic solution's tests takes (0.06 s), and twice what it takes with evalF at 5 ms, the slowest right one that was
/// met.
constexpr double least_cpu = 30;
/// Code may take so many times what the official solution takes for the same calls on the same machine.
constexpr double times_reference = 20;

/// The limits of a test whose calls cost the official solution `reference` s. Only processor time decides: the clock is
/// sixty times further, for a machine with sixty busy programs on a processor, and whoever waits is found by that.
Limits limits_for(double reference, double least = least_cpu);

/// An answer per case, whatever the program does; `captured`: the first of what it printed. `token` is what it must say
/// at the end.
std::vector<Answer> run_calls(const Sandbox& sandbox, const std::filesystem::path& program,
                              const std::vector<Case>& cases, const Limits& limits = limits_for(0),
                              double* cpu = nullptr, std::string* captured = nullptr);

/// What may be shown of the text of an exception: all of it where it stands in one of the student's files or comes from
/// the standard library, numbers of up to six digits aside; else nothing. Whatever else a program can get hold of, our
/// code and texts among it, does not leave this way.
std::string shown_exception(const std::string& text, const std::map<std::string, std::string>& files);

/// What the lines on descriptor 3 and the end of the process mean for each of `count` calls. Lines that are not of the
/// form that tests/coursework/check/child_main.cpp writes make all of them How::no_token.
std::vector<Answer> answers_of(const End& end, const std::string& token, std::size_t count, const Limits& limits);

}  // namespace coursework
