// The result of grading one submission, as JSON, as text for the terminal and as a page.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tests/coursework/check/judge.h"
#include "tests/coursework/check/texts.h"

namespace coursework {

struct TestResult {
  std::string id, part, title;
  std::string heading;  // above the tests of a part: the file's name, or the part's title
  bool hidden = false;
  bool ungraded = false;  // a limit of ours kept it from being judged: no points, which are not zero points
  double points = 0, earned = 0;
  std::vector<std::string> concepts;
  std::string said;   // for the student: what was expected, what came, the first row that differs
  std::string cause;  // the likely cause, or that no known mistake matches; empty where right
  std::string read;   // heading of the handout
  std::string plot;   // SVG; empty: none
  double seconds = 0;
  std::string reason = {};  // why the lecturer set the points (rubric.h); not part of the JSON
};

struct Result {
  std::string assignment, submission, sandbox;
  unsigned long long seed = 0;         // of the hidden tests
  bool secret = false;                 // the seed was made from the lecturer's secret: it must not be shown
  std::vector<std::string> preflight;  // lines: files missing, first errors of the compiler in plain words
  std::vector<TestResult> tests;
  std::string remark = {};      // the sentence on it that helps most
  std::string not_graded = {};  // why nothing of it could be graded; empty: it was
  bool complete = false;        // false while tests are still to run
  double earned() const;
  double points() const;
  double ungraded() const;  // points of tests that could not be graded
};

/// Whether all its points were earned, on a test that was run.
bool passed(const TestResult& test);

/// "passed", "failed" or "ungraded": a key of the common texts.
std::string_view status_of(const TestResult& test);

/// The result as JSON, and back: an interrupted class is continued from it. A fingerprint stands beside it where there
/// is one: what was graded, and by what. Throws InputError that names the file.
std::string to_json(const Result& result, const std::string& fingerprint = "");
Result result_from_json(const std::string& text, const std::string& file, std::string* fingerprint = nullptr);

// A result for people: plain text for the terminal, and a page.

/// Plain text; `common` is check/common.LANGUAGE.txt.
std::string text_of(const Result& result, const Texts& common);

/// One self-contained page with the same words, and the plots. `own` names the parts.
std::string page_of(const Result& result, const Texts& common, const Texts& own, const std::string& charts = "");

/// "Total: 85 of 100 points", and where all public tests passed and hidden ones have still to run, how many.
std::string total_of(const Result& result, const Texts& common);

/// Causes of which several public tests of a part fail, each told once: their lines_on() refer to it.
std::vector<std::string> causes_of(const Result& result, const Texts& common);

/// What is said of a test that was not passed, line by line; empty where it was. `alone`: there is no top to refer to.
std::vector<std::string> lines_on(const Result& result, const TestResult& test, const Texts& common,
                                  bool alone = false);

/// One line of valid UTF-8 without control characters: students' programs and archives may have put anything into what
/// is said of them.
std::string printable(std::string text);

/// "3 of 5 points", or that 5 are left open.
std::string points_of(const TestResult& test, const Texts& common);

/// Points without needless digits.
std::string points_text(double points);

}  // namespace coursework
