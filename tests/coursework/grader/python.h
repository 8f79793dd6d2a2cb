// Parts in Python. An interpreter in the sandbox runs the student's code; a program outside of the sandbox calls it
// (python/remote.h). Cases, f, official functions and counts are in that program, as for C++.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "tests/coursework/grader/build.h"

namespace coursework {

/// CPU time (s) for starting the interpreter and importing, in addition to the time of a test's calls.
constexpr double import_cpu = 10;

/// True if the assignment's parts name Python functions.
bool has_python(const Assignment& assignment);

std::vector<std::string> python_files(const Assignment& assignment);

/// The Debian package that is missing for grading Python here, or an empty string. The interpreter is /usr/bin/python3,
/// or the one in the environment variable CROSSCHECK_PYTHON.
std::string missing_python_package();

/// A builder for Python, whose Built::program is a file that run_python() reads.
std::unique_ptr<Builder> python_builder(const Assignment& assignment, const Sandbox& trusted, const Sandbox& sandbox);

/// True if python_builder() has made the program.
bool is_python_program(const std::filesystem::path& program);

/// Runs the program that calls the part, with the job's input, and, in the sandbox, the interpreter that it calls.
/// Returns how the interpreter ended if it ended first, otherwise how the program ended.
End run_python(const Sandbox& sandbox, const std::filesystem::path& program, const Job& job);

/// The text of a Python exception that may be shown. For public tests, this is the whole text, because the
/// interpreter knows no secrets. For hidden tests, whose inputs the text may contain, it is only the student's line and
/// a known type of exception.
std::string shown_python_exception(const std::string& text, const std::map<std::string, std::string>& files,
                                   bool hidden);

}  // namespace coursework
