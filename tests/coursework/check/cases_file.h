// The public tests as a text file: calls and right answers.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "case.h"

namespace coursework {

struct PublicTest {
  std::string id, part, read;  // as in the grader; `read`: heading of the section of the hand-out to read
  int points = 0;
  std::vector<Case> cases;  // empty if only the grader runs the test
  std::vector<Case> small;  // `check` runs these if the test fails; they do not affect the verdict
};

struct PublicTests {
  std::string assignment, title;
  int hidden = 0;  // number of tests that only the grader runs
  std::vector<PublicTest> tests;
};

/// Writes lines of a keyword and its values. Numbers have 17 digits and read back as the same double, also nan and inf.
void write_cases(std::ostream& out, const PublicTests& tests);

/// Throws std::runtime_error with the line number if the file is unreadable, a keyword is unknown, a number is
/// malformed, or there are too few numbers.
PublicTests read_cases(std::istream& in);

}  // namespace coursework
