// Formats of results for other programs, and the plain text that they share. The table of formats is in formats.cpp.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "tests/coursework/check/texts.h"
#include "tests/coursework/grader/result.h"

namespace coursework {

struct Format {
  std::string_view name;
  std::string_view file;                                     // its usual name
  std::string (*write)(const Result&, const Texts& common);  // common: check/common.LANGUAGE.txt
};

std::span<const Format> formats();
/// Throws std::invalid_argument that lists what there is.
const Format& find_format(const std::string& name);

/// results.json of Gradescope's harness, every documented field. Hidden tests are shown after the grades are published.
std::string gradescope(const Result& result, const Texts& common);
/// JUnit XML, a suite per part. It is read where students read it too (GitHub Classroom, CI): hidden tests stand in it
/// as skipped, with a message that says so, and neither their verdict nor their numbers.
std::string junit(const Result& result, const Texts& common);
/// Feedback on the public tests, then Autolab's line of scores: a problem per part with its public points, and one
/// named "hidden" with those of all hidden tests. The scoreboard has the public points alone.
std::string autolab(const Result& result, const Texts& common);

// The plain text that all formats share.

/// The same text as valid UTF-8 that JSON and XML can carry: bytes that are no UTF-8, and control characters other than
/// tab and line feed, become U+FFFD. What a student's program threw or printed may hold anything.
std::string clean(const std::string& text);

/// The text of a cell of CSV, with an apostrophe where a spreadsheet could take it for a formula.
std::string defused(const std::string& text);

/// What was said, the likely cause, and what to read, as on the terminal; empty where it was passed. `alone` as
/// in lines_on().
std::string feedback_on(const Result& result, const TestResult& test, const Texts& common, bool alone = false);

/// Preflight, what the public tests earned, and how many more run. Nothing in it depends on how the hidden tests went.
std::string summary_of(const Result& result, const Texts& common);

}  // namespace coursework
