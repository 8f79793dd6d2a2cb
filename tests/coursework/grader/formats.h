// Result formats for other programs, and the plain text that they share. formats.cpp has the table of formats.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "tests/coursework/check/texts.h"
#include "tests/coursework/grader/result.h"

namespace coursework {

struct Format {
  std::string_view name;
  std::string_view file;                                     // default file name
  std::string (*write)(const Result&, const Texts& common);  // `common` are the texts in check/common.LANGUAGE.txt
};

std::span<const Format> formats();
/// Throws std::invalid_argument with a list of the known formats.
const Format& find_format(const std::string& name);

/// Gradescope's results.json with every documented field. Hidden tests become visible when the grades are published.
std::string gradescope(const Result& result, const Texts& common);
/// JUnit XML with a suite per part. Students can read it too (GitHub Classroom, CI), so hidden tests appear as skipped
/// with an explanation, without verdict or numbers.
std::string junit(const Result& result, const Texts& common);
/// Feedback on the public tests, then Autolab's line of scores: a problem per part with its public points, and a
/// problem "hidden" with the points of all hidden tests. The scoreboard shows only the public points.
std::string autolab(const Result& result, const Texts& common);

// Plain text shared by all formats.

/// The text as valid UTF-8 for JSON and XML. Invalid bytes, and control characters other than tab and line feed, become
/// U+FFFD, because exceptions and output of a student's program may contain anything.
std::string clean(const std::string& text);

/// The text of a CSV cell, with an apostrophe in front if a spreadsheet could interpret it as a formula.
std::string defused(const std::string& text);

/// Feedback, likely cause and reading, as on the terminal; empty if the test was passed. `alone` means the same as in
/// lines_on().
std::string feedback_on(const Result& result, const TestResult& test, const Texts& common, bool alone = false);

/// Preflight remarks, points of the public tests, and the number of remaining tests. Independent of hidden verdicts.
std::string summary_of(const Result& result, const Texts& common);

}  // namespace coursework
