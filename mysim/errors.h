// The two ways in which a request is refused: bad input (exit 2) and what a method lacks (a row, not a crash).
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

}  // namespace crosscheck
