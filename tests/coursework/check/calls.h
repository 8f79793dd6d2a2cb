// A function that dispatches all calls of the student's code; each assignment defines it.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "case.h"
#include "texts.h"

namespace coursework {

/// Thrown by the assignment's calls if the student's code returns an unusable value. The report is the text
/// unusable.KEY, into which the numbers are inserted.
class Unusable : public std::runtime_error {
 public:
  explicit Unusable(const std::string& key, const std::vector<std::size_t>& numbers = {})
      : std::runtime_error(key), numbers_(numbers) {}
  const std::vector<std::size_t>& numbers() const { return numbers_; }

 private:
  std::vector<std::size_t> numbers_;
};

/// Announces a call of the student's function, so that the message on slow code can name that function. Each program
/// that runs the student's code defines calling().
void calling(const char* function);

/// Calls the student's code. Returns false if no part knows the call. Lets exceptions of the student's code through.
using Calls = bool(const std::string& call, const Numbers& in, Numbers& out);

/// Each assignment defines this in calls.cpp, which tries its parts in turn: `Calls answer_P` of part P is in
/// calls_P.cpp.
Calls answer;

/// Only for the hand-out's `check`: the numbers that are compared with the case's `expected`. These are all numbers of
/// the answer (as_given.cpp) or, if students choose the constants, the features that the assignment's calls.cpp
/// extracts.
Found compared(const Case& what, const Numbers& answered);

/// Only for the hand-out's `check`: the inputs and the answer as text if features of the answer are compared; otherwise
/// an empty string.
std::string asked_and_came(const Texts& own, const Case& what, const Numbers& answered);

/// Only for the hand-out's `check`: a motion to draw for a test that compares no curve itself. `expected` is the right
/// motion, `got` the student's. Returns false if there is no motion. Lets exceptions of the student's code through.
bool motion_of(const std::string& test, Case& drawn, Numbers& got);

}  // namespace coursework
