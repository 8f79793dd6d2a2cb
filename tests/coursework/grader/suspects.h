// Causes that are found by experiment: something is changed, and all that was wrong is right.
#pragma once

#include <filesystem>
#include <vector>

#include "tests/coursework/check/texts.h"
#include "tests/coursework/grader/build.h"
#include "tests/coursework/grader/mistakes.h"
#include "tests/coursework/grader/sandbox.h"
#include "tests/coursework/grader/submission.h"

namespace coursework {

/// What experiments need: the student's program of a part, and what makes others of it.
struct Subject {
  const Sandbox& sandbox;
  const Builder& builder;
  const Submission& submission;
  const Texts& own;  // the assignment's: its layouts say which numbers are angles
  std::filesystem::path program;
  std::filesystem::path scratch;  // for what is built; need not exist
};

/// What experiments on a part's wrong answers show: single precision, something kept from call to call, an angle in
/// degrees, a division of whole numbers. No key: nothing.
Remark suspected(const Subject& subject, const std::vector<TestRun>& of_part);

/// False where std::regex could not look through a source, comments and strings left out: it takes stack for each
/// character of a run of blanks or of a word, and the experiments look for each word in the whole.
bool can_be_searched(const std::string& source);

/// Where whole numbers may be divided: the places of `/` in a source, comments and strings left out, between what are
/// whole numbers by their look: literals, names declared so, size(), and brackets beside a literal.
std::vector<std::size_t> whole_divisions(const std::string& source);

}  // namespace coursework
