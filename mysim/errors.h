// How a request is refused: bad input (exit 2), what a method lacks, and a solver that gave up (rows, not crashes).
#pragma once

#include <stdexcept>

namespace crosscheck {

/// Bad use or bad input. what() is one line that names the file, the key and what was expected.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A method lacks an ingredient of the scene. what() is the reason, without the method's name.
struct Unsupported : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A solver inside a step found no answer: the run ends with Verdict::solver. what() is the reason.
struct SolverFailure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace crosscheck
