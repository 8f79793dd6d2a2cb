// mine.html: each public test with its feedback, and the student's curve over the right one.
#pragma once

#include <string>
#include <vector>

namespace coursework {

struct ShownTest {
  std::string part, heading;  // the part's title; the test's number and title
  bool passed = false;
  std::string said;                // lines of feedback; empty if the test passed
  std::vector<std::string> plots;  // SVG
};

/// Text of the page. `language`: the lang attribute; `total`: a line below the title.
std::string page(const std::string& language, const std::string& title, const std::string& total,
                 const std::vector<ShownTest>& tests, const std::string& passed, const std::string& failed);

/// A paragraph for each line; consecutive lines of a table stay together.
std::string paragraphs(const std::vector<std::string>& lines);

}  // namespace coursework
