// One function that dispatches all calls of the student's code; each assignment defines it. C++17, standard library
// only.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "case.h"
#include "texts.h"

namespace coursework {

/// Thrown by the calls around the student's code if its return value is unusable; reported with the text unusable.KEY,
/// into which the numbers are inserted.
class Unusable : public std::runtime_error {
 public:
  explicit Unusable(const std::string& key, const std::vector<std::size_t>& numbers = {})
      : std::runtime_error(key), numbers_(numbers) {}
  const std::vector<std::size_t>& numbers() const { return numbers_; }

 private:
  std::vector<std::size_t> numbers_;
};

/// Announces a call of this student function, for the message on code that is too slow. Each program around the code
/// defines it.
void calling(const char* function);

/// Calls the student's code. Returns false if no part knows the call. Lets exceptions of the student's code through.
using Calls = bool(const std::string& call, const Numbers& in, Numbers& out);

/// Each assignment defines this in calls.cpp, which tries its parts in turn: `Calls answer_P` of part P is in
/// calls_P.cpp.
Calls answer;

/// Only for the hand-out's `check`: the numbers of an answer to compare with the case's `expected`. All of them
/// (as_given.cpp), or the features that the assignment's calls.cpp extracts, if students choose the constants.
Found compared(const Case& what, const Numbers& answered);

/// Only for the hand-out's `check`: the question and the answer as text, if the compared numbers are not the answer
/// itself; otherwise empty.
std::string asked_and_came(const Texts& own, const Case& what, const Numbers& answered);

/// Only for the hand-out's `check`: a motion to draw for a test that compares no curve itself. `expected` is the right
/// motion, `got` the student's. Returns false if there is none. Lets exceptions of the student's code through.
bool motion_of(const std::string& test, Case& drawn, Numbers& got);

}  // namespace coursework
