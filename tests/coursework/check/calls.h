// One function for all calls of the student's code; each assignment defines it. C++17, standard library only.
#pragma once

#include <string>

#include "case.h"

namespace coursework {

/// Calls the student's code. Returns false where no part knows the call. What the student's code throws passes through.
/// Each assignment defines it in calls.cpp, which asks its parts one after the other; part P lives in calls_P.cpp and
/// has the form `bool answer_P(const std::string& call, const Numbers& in, Numbers& out)`.
bool answer(const std::string& call, const Numbers& in, Numbers& out);

/// Of the hand-out's `check` alone: what of an answer stands beside the case's `expected`. All of it (as_given.cpp), or
/// what the assignment's calls.cpp finds in it, where constants are the student's choice.
Found compared(const Case& what, const Numbers& answered);

/// Of the hand-out's `check` alone: a motion to draw beside a test that compares no curve itself, `expected` the right
/// one and `got` the student's. False: there is none. What the student's code throws passes through.
bool motion_of(const std::string& test, Case& drawn, Numbers& got);

}  // namespace coursework
