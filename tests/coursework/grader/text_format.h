// A result for people: plain text for the terminal, and a page.
#pragma once

#include <string>

#include "tests/coursework/check/texts.h"
#include "tests/coursework/grader/result.h"

namespace coursework {

/// Plain text; `common` is check/common.LANGUAGE.txt.
std::string text_of(const Result& result, const Texts& common);

/// One self-contained page with the same words, and the plots. `own` names the parts.
std::string page_of(const Result& result, const Texts& common, const Texts& own, const std::string& charts = "");

/// "Total: 85 of 100 points", and where all public tests passed and hidden ones have still to run, how many.
std::string total_of(const Result& result, const Texts& common);

/// What is said of a test that was not passed, line by line; empty where it was.
std::vector<std::string> lines_on(const Result& result, const TestResult& test, const Texts& common);

/// One line without control characters: students' programs and archives may have put anything into what is said of
/// them.
std::string printable(std::string text);

/// Points without needless digits.
std::string points_text(double points);

}  // namespace coursework
