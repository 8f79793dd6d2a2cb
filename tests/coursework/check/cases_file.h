// The public tests as a text file: calls and right answers. C++17, standard library only.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "case.h"

namespace coursework {

struct PublicTest {
  std::string id, part, read;  // as in the grader; `read` is a heading of the hand-out
  int points = 0;
  std::vector<Case> cases;  // none: only the grader runs it
  std::vector<Case> small;  // tried if the test fails; without effect on the verdict
};

struct PublicTests {
  std::string assignment, title;
  int hidden = 0;  // tests that run later, in the grader
  std::vector<PublicTest> tests;
};

/// Lines of a keyword and its values. Numbers have 17 digits and read back as the same double, including nan and inf.
void write_cases(std::ostream& out, const PublicTests& tests);

/// Throws std::runtime_error with the line number if the file is unreadable, a keyword is unknown, a number is
/// malformed, or there are too few numbers.
PublicTests read_cases(std::istream& in);

}  // namespace coursework
