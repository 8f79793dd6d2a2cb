// Parts in Python: an interpreter in the sandbox runs the student's code, and the program around it, outside, asks it
// (python/remote.h). Cases, f, official functions and counts stay in that program, which is the same as for C++.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "tests/coursework/grader/build.h"

namespace coursework {

/// CPU time (s) for the start of the interpreter and the imports, in addition to that of a test's calls.
constexpr double import_cpu = 10;

/// True if the assignment's parts name Python functions.
bool has_python(const Assignment& assignment);

/// Files of the parts in Python.
std::vector<std::string> python_files(const Assignment& assignment);

/// The Debian package without which no Python can be graded here; empty if none is missing. The interpreter is
/// /usr/bin/python3, or the one in the environment variable CROSSCHECK_PYTHON.
std::string missing_python_package();

/// Built::program is a file that run_python() reads.
std::unique_ptr<Builder> python_builder(const Assignment& assignment, const Sandbox& trusted, const Sandbox& sandbox);

/// True if a program is one of python_builder().
bool is_python_program(const std::filesystem::path& program);

/// Runs the program around the part, with the job's input, and the interpreter that it asks, in the sandbox. The end is
/// that of the interpreter if that ended first.
End run_python(const Sandbox& sandbox, const std::filesystem::path& program, const Job& job);

/// The text of a Python exception that may be shown: all of it, because nothing of ours is in the interpreter; of a
/// hidden test, whose inputs it may contain, only the student's line and a known type of exception.
std::string shown_python_exception(const std::string& text, const std::map<std::string, std::string>& files,
                                   bool hidden);

}  // namespace coursework
