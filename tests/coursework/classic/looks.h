// Extracts the features that a test compares from the recorded answers of a probe. The case's column determines which
// oracle computes them. Shared by the grader and by the hand-out's `check`: standard library only.
#pragma once

#include "tests/coursework/check/case.h"
#include "tests/coursework/check/texts.h"

namespace coursework::classic {

/// The features to compare with the case's `expected`. `answers` are the recorded answers of the student's evalF
/// (probe/ask.h), which may be forged. Empty if they cannot be measured because evalF is not deterministic. Answers of
/// calls that are not probes are returned unchanged. Throws std::logic_error if no oracle exists for the case's column.
Found features(const Case& what, const Numbers& answers);

/// Text with question and answer, in numbers, for the first wrong particle or spring; `own` are the assignment's texts.
/// Empty if no single particle or spring is wrong.
std::string shown(const Texts& own, const Case& what, const Numbers& answers);

}  // namespace coursework::classic
