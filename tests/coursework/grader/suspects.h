// Causes found by experiment: all wrong answers become right after a change of the program or of its inputs.
#pragma once

#include <filesystem>
#include <vector>

#include "tests/coursework/check/texts.h"
#include "tests/coursework/grader/build.h"
#include "tests/coursework/grader/mistakes.h"
#include "tests/coursework/grader/sandbox.h"
#include "tests/coursework/grader/submission.h"

namespace coursework {

/// Inputs of the experiments: the student's program of a part, and the means to build variants.
struct Subject {
  const Sandbox& sandbox;
  const Builder& builder;
  const Submission& submission;
  const Texts& own;  // the assignment's texts; their layouts mark angles
  std::filesystem::path program;
  std::filesystem::path scratch;  // folder for built files, which need not exist
};

/// Runs experiments on a part's wrong answers: single precision, state kept between calls, an angle in degrees, an
/// integer division. The remark's key is empty if none of them is the cause.
Remark suspected(const Subject& subject, const std::vector<TestRun>& of_part);

/// Returns false if std::regex could overflow the stack on this source. It uses stack for each character of a run of
/// blanks or of a word, and the experiments search for each word in the whole source.
bool can_be_searched(const std::string& source);

/// Possible integer divisions: positions of `/` in the source (outside of comments and strings) between operands that
/// look like integers: literals, integer variables, size(), or brackets next to a literal.
std::vector<std::size_t> whole_divisions(const std::string& source);

}  // namespace coursework
