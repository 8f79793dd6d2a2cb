// What a grading is written as for the programs that read it. The table of formats is in formats.cpp.
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
  std::string_view what;
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

}  // namespace coursework
