// The public tests as a text file: calls and right answers. C++17, standard library only.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "case.h"

namespace coursework {

struct PublicTest {
  std::string id, part, read;  // as the grader's; `read` is a heading of the handout
  int points = 0;
  std::vector<Case> cases;  // none: only the grader runs it
  std::vector<Case> small;  // that are tried where it fails, and decide nothing
};

struct PublicTests {
  std::string assignment, title;
  int hidden = 0;  // tests that run later
  std::vector<PublicTest> tests;
};

/// Lines of a word and what belongs to it; numbers with 17 digits, which read back as the same double. nan and inf are
/// written as such.
void write_cases(std::ostream& out, const PublicTests& tests);

/// Throws std::runtime_error that names the line: unreadable, an unknown word, a number that is none, too few numbers.
PublicTests read_cases(std::istream& in);

}  // namespace coursework
