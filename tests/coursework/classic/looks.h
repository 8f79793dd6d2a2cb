// What a test compares of the answers that a probe recorded: its case names the column, and the column the oracle.
// Shared by the grader and by the hand-out's `check`: standard library only.
#pragma once

#include "tests/coursework/check/case.h"

namespace coursework::classic {

/// The features that stand beside the case's `expected`. `answers` is what the student's evalF said (probe/ask.h),
/// whoever wrote it down; none where they cannot be measured, because it does not answer the same twice. Answers of
/// calls that are no probes come back as they are. Throws std::logic_error where no oracle finds the case's column.
Found features(const Case& what, const Numbers& answers);

}  // namespace coursework::classic
