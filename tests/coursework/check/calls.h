// One function for all calls of the student's code; each assignment defines it. C++17, standard library only.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "case.h"
#include "texts.h"

namespace coursework {

/// What came from the student's code cannot be worked with: thrown by the calls around it, told with the text
/// unusable.KEY and these numbers in it.
class Unusable : public std::runtime_error {
 public:
  explicit Unusable(const std::string& key, const std::vector<std::size_t>& numbers = {})
      : std::runtime_error(key), numbers_(numbers) {}
  const std::vector<std::size_t>& numbers() const { return numbers_; }

 private:
  std::vector<std::size_t> numbers_;
};

/// Says that this function of the student's is called now: told where the code is too slow. Each program around the
/// code defines it.
void calling(const char* function);

/// Calls the student's code. Returns false where no part knows the call. What the student's code throws passes through.
/// Each assignment defines it in calls.cpp, which asks its parts one after the other; part P lives in calls_P.cpp and
/// has the form `bool answer_P(const std::string& call, const Numbers& in, Numbers& out)`.
bool answer(const std::string& call, const Numbers& in, Numbers& out);

/// Of the hand-out's `check` alone: what of an answer stands beside the case's `expected`. All of it (as_given.cpp), or
/// what the assignment's calls.cpp finds in it, where constants are the student's choice.
Found compared(const Case& what, const Numbers& answered);

/// Of the hand-out's `check` alone: where an answer is no numbers that are compared as they are, what was asked and
/// what came; else empty.
std::string asked_and_came(const Texts& own, const Case& what, const Numbers& answered);

/// Of the hand-out's `check` alone: a motion to draw beside a test that compares no curve itself, `expected` the right
/// one and `got` the student's. False: there is none. What the student's code throws passes through.
bool motion_of(const std::string& test, Case& drawn, Numbers& got);

}  // namespace coursework
