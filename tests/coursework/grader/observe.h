// Observations from repeating a wrong call with other numbers: inputs for which the student's answers would be right,
// and terms without which the answers are right.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/coursework/grader/mistakes.h"

namespace coursework {

/// Runs a program in a sandbox, with a limit of a few seconds.
Ask asking(const Sandbox& sandbox, const std::filesystem::path& program);

struct Observing {
  Ask student, reference;  // the part as the student wrote it, and the official solution
  const Texts &common, &own;
};

/// Observations for each run of a part's tests; "" if there are none, or the run is not in `told_at`. The first run has
/// the result of the assignment's formula analysis. For each call with a wrong answer, the first run with this call has
/// the following observations:
///
/// First, runs the official solution with one change: a number is set to zero or one, negated, doubled, halved,
/// exchanged with another number, or replaced by the first value or a neighbour's; or a list has no items. Changes that
/// reproduce all of the student's answers are reported ("right with drag = 0"), unless there are more than three.
/// Otherwise, runs both programs on the smallest wrong case with one term removed. If the student's answer without the
/// term is right, reports the term, and what the student's code computes in its place.
std::vector<std::string> seen_at(const Observing& with, const Assignment& assignment, const std::string& part,
                                 const std::vector<TestRun>& runs, const std::vector<bool>& told_at);

}  // namespace coursework
