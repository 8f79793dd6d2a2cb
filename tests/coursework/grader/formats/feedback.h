// What all formats say of a grading in plain text.
#pragma once

#include <string>

#include "tests/coursework/check/texts.h"
#include "tests/coursework/grader/result.h"

namespace coursework {

/// The same text as valid UTF-8 that JSON and XML can carry: bytes that are no UTF-8, and control characters other than
/// tab and line feed, become U+FFFD. What a student's program threw or printed may hold anything.
std::string clean(const std::string& text);

/// What was said, the likely cause, and what to read, as on the terminal; empty where it was passed.
std::string feedback_on(const Result& result, const TestResult& test, const Texts& common);

/// Preflight, what the public tests earned, and how many more run. Nothing in it depends on how the hidden tests went.
std::string summary_of(const Result& result, const Texts& common);

}  // namespace coursework
