// Observations from repeating a wrong call with other numbers: inputs for which the student's answers would be right,
// and terms without which they are.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/coursework/grader/mistakes.h"

namespace coursework {

/// Runs a program in a sandbox, with a limit of a few seconds.
Ask asking(const Sandbox& sandbox, const std::filesystem::path& program);

struct Observing {
  Ask student, reference;  // the part as it was handed in, and the official solution
  const Texts &common, &own;
};

/// Observations for each run of a part's tests, "" if there are none; only for runs in `told_at`. The first has the
/// result of the assignment's formula analysis; for each call that is answered wrongly, the first run with this call
/// has the following:
///
/// First, runs the official solution with one change: a number set to zero or one, negated, doubled, halved, exchanged
/// with another number, replaced by a neighbour's or the first value, or a list without items. Changes that reproduce
/// all of the student's answers are reported ("right with drag = 0"), unless more than three do.
/// Otherwise runs both on the smallest wrong case with one term removed: if the student is right then, reports this
/// term, and the student's contribution in its place.
std::vector<std::string> seen_at(const Observing& with, const Assignment& assignment, const std::string& part,
                                 const std::vector<TestRun>& runs, const std::vector<bool>& told_at);

}  // namespace coursework
