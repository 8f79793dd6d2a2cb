// The result of grading one submission, as JSON, as text for the terminal, and as a page.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tests/coursework/check/texts.h"

namespace coursework {

struct TestResult {
  std::string id, part, title;
  std::string heading;  // above the tests of a part: the file's name, or the part's title
  bool hidden = false;
  bool ungraded = false;  // one of our limits prevented a verdict: the test has no grade, instead of 0 points
  double points = 0, earned = 0;
  std::vector<std::string> concepts;
  std::string said;   // feedback for the student: expected and actual numbers, the first row that differs
  std::string cause;  // the likely cause, or that no known mistake matches; empty if the answers are right
  std::string read;   // heading of the hand-out's section to read
  std::string plot;   // SVG, or empty
  double seconds = 0;
  std::string reason = {};  // the lecturer's reason for changed points (rubric.h); not part of the JSON
};

struct Result {
  std::string assignment, submission, sandbox;
  unsigned long long seed = 0;         // for the hidden tests
  bool secret = false;                 // derived from the lecturer's secret, so it must not be shown
  std::vector<std::string> preflight;  // lines: missing files, and the compiler's first errors in readable form
  std::vector<TestResult> tests;
  std::string remark = {};      // the most helpful sentence of the feedback
  std::string not_graded = {};  // reason, if nothing of the submission could be graded; otherwise empty
  bool complete = false;        // false while tests are still to run
  double earned() const;
  double points() const;
  double ungraded() const;  // points of tests that could not be graded
};

/// True if the test was run and earned all its points.
bool passed(const TestResult& test);

/// "passed", "failed" or "ungraded": a key of the common texts.
std::string_view status_of(const TestResult& test);

/// Convert a result to JSON and back, which allows resuming an interrupted run. The JSON contains the fingerprint of
/// the graded files and the grader, if there is one. Reading throws InputError with the file.
std::string to_json(const Result& result, const std::string& fingerprint = "");
Result result_from_json(const std::string& text, const std::string& file, std::string* fingerprint = nullptr);

/// The result as plain text; `common` are the texts in check/common.LANGUAGE.txt.
std::string text_of(const Result& result, const Texts& common);

/// One self-contained page with the text of text_of() and the plots. `own` has the names of the parts.
std::string page_of(const Result& result, const Texts& common, const Texts& own, const std::string& charts = "");

/// "Total: 85 of 100 points", and the number of remaining hidden tests if all public tests passed.
std::string total_of(const Result& result, const Texts& common);

/// Causes that several public tests of a part share, each reported once. lines_on() of these tests refers to them.
std::vector<std::string> causes_of(const Result& result, const Texts& common);

/// Feedback on a test, line by line; empty if the test was passed. `alone`: there is no summary to refer to.
std::vector<std::string> lines_on(const Result& result, const TestResult& test, const Texts& common,
                                  bool alone = false);

/// One line of valid UTF-8 without control characters, because messages can quote arbitrary text of students' programs
/// and archives.
std::string printable(std::string text);

/// "3 of 5 points", or that 5 points are not graded.
std::string points_of(const TestResult& test, const Texts& common);

/// Points without trailing zeros.
std::string points_text(double points);

}  // namespace coursework
