// What grading one submission gave; the formats are made of it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tests/coursework/check/judge.h"

namespace coursework {

struct TestResult {
  std::string id, part, title;
  std::string heading;  // what stands above the tests of a part: the file's name, or the part's title
  bool hidden = false;
  double points = 0, earned = 0;
  std::vector<std::string> concepts;
  std::string said;   // for the student: what was expected, what came, the first row that differs
  std::string cause;  // the likely cause, or that no known mistake matches; empty where right
  std::string read;   // heading of the handout
  std::string plot;   // SVG; empty: none
  double seconds = 0;
};

struct Result {
  std::string assignment, submission, lane;
  unsigned long long seed = 0;         // of the hidden tests
  bool secret = false;                 // the seed was made from the lecturer's secret: it must not be shown
  std::vector<std::string> preflight;  // lines: files missing, first errors of the compiler in plain words
  std::vector<TestResult> tests;
  bool complete = false;  // false while tests are still to run
  double earned() const;
  double points() const;
};

/// Whether all its points were earned, on a test that was run.
bool passed(const TestResult& test);

/// All of it as JSON, and back: how an interrupted class goes on. A fingerprint stands beside it where there is one:
/// what was graded, and by what. Throws InputError that names the file.
std::string to_json(const Result& result, const std::string& fingerprint = "");
Result result_from_json(const std::string& text, const std::string& file, std::string* fingerprint = nullptr);

}  // namespace coursework
