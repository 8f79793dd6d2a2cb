// Exceptions for bad input, unsupported scenes and failed solvers, with their messages and exit status.
#pragma once

#include <exception>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace crosscheck {

/// Wrong usage or bad input. what() is one line that names the file, the key and what was expected.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A method does not support an ingredient of the scene. what() is the reason, without the method's name.
struct Unsupported : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A solver inside a step found no solution: the run ends with Verdict::solver. what() is the reason.
struct SolverFailure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The message of an exception: one line that names the file or folder concerned, without library-specific wording.
std::string in_words(const std::exception_ptr& thrown);

/// Runs a program's work and returns its exit status. Reports an exception on standard error, in one line that begins
/// with the program's name, and returns 2. If the answer is no, such as a failed check, the work returns 1.
int run_reporting_errors(std::string_view program, const std::function<int()>& work);

}  // namespace crosscheck
