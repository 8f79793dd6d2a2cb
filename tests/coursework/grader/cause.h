// Which known mistake a student's answers look like.
#pragma once

#include <string>
#include <vector>

#include "tests/coursework/grader/assignment.h"
#include "tests/coursework/grader/build.h"

namespace coursework {

/// One test of a part as it was asked, and what came; answers are reduced where the test reduces.
struct Asked {
  const Test* test = nullptr;
  std::vector<Case> cases;
  std::vector<Answer> answers;
};

/// The answer as it is compared with what is right.
Answer reduced(const Test& test, const Case& what, Answer raw);

/// Whether two wrong answers are the same one: the tolerance grows with the answers where they are larger than the
/// right ones, so that two ways to write one mistake agree on a motion that blows up.
bool agree(const Case& what, const Answer& student, const Answer& mistake);

/// The name of the one mistake of `known` whose program answers all that was asked as the student's did; empty where
/// none does, or several. `asked` are all the tests of one part.
std::string likely_cause(const Assignment& assignment, const std::string& part, const std::vector<Asked>& asked,
                         const std::vector<Mistake>& known, const Builder& builder, const Lane& trusted, unsigned jobs);

}  // namespace coursework
