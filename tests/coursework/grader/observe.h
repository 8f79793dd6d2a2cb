// What is seen when a wrong call is asked again with other numbers: for which the student's answers would be right,
// and without which they are.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/coursework/grader/mistakes.h"

namespace coursework {

/// A program, asked in a sandbox for a few seconds at most.
Ask asking(const Sandbox& sandbox, const std::filesystem::path& program);

struct Observing {
  Ask student, reference;  // the part as it was handed in, and the official solution
  const Texts &common, &own;
};

/// What is said beside each run of a part's tests, "" where nothing is; only at those that are `told_at`. The first has
/// what the assignment's own look finds; of each call that is answered wrongly the first that makes it has this:
///
/// First the official solution is asked with one thing changed: a number zero, one, of the other sign, twice, half,
/// exchanged with another one, of the neighbour, of the first, a list without its items. Where it then answers all
/// that was asked as the student did, that is told ("right with drag = 0"); no more than three that do so alike.
/// Else both are asked for the smallest wrong case without one thing each: where the student is right then, that thing
/// is told, and what the student has in place of what it adds.
std::vector<std::string> seen_at(const Observing& with, const Assignment& assignment, const std::string& part,
                                 const std::vector<TestRun>& runs, const std::vector<bool>& told_at);

}  // namespace coursework
