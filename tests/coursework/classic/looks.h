// What a test compares of the answers that a probe recorded: its case names the column, and the column the oracle.
// Shared by the grader and by the hand-out's `check`: standard library only.
#pragma once

#include "tests/coursework/check/case.h"
#include "tests/coursework/check/texts.h"

namespace coursework::classic {

/// The features that stand beside the case's `expected`. `answers` is what the student's evalF said (probe/ask.h),
/// whoever wrote it down; none where they cannot be measured, because it does not answer the same twice. Answers of
/// calls that are no probes come back as they are. Throws std::logic_error where no oracle finds the case's column.
Found features(const Case& what, const Numbers& answers);

/// What was asked and what came, in numbers, of the first particle or spring of such answers that is not as it should
/// be; `own` are the assignment's texts. Empty where there is none to single out.
std::string shown(const Texts& own, const Case& what, const Numbers& answers);

}  // namespace coursework::classic
