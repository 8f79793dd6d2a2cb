// A call of the student's code and the expected answer. The files that the grader shares with the hand-out's `check`
// need only C++17 and the standard library.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace coursework {

using Numbers = std::vector<double>;

/// A call of a student's function. The assignment's calls_PART.cpp defines its name and the layout of its numbers.
struct Case {
  std::string call;
  Numbers in;
  Numbers expected;      // row by row
  int columns = 1;       // numbers in a row
  double tolerance = 0;  // absolute, for each number
  std::string row;       // what a row is, as a key of the texts: "step", "particle", "spring"
  std::string column;    // what a row contains, as a key of the texts: "state", "force"
  int plot_x = -1;       // column drawn along x, or -1 to draw the index of the row times `row_size`
  int plot_y = -1;       // column drawn along y, or -1 to draw nothing
  double row_size = 1;   // extent of a row along x, in s if rows are steps
};

enum class How {
  answered,
  threw,
  unusable,  // the calls threw Unusable
  crashed,
  recursion,    // infinite recursion: the stack overflowed
  out_of_time,  // CPU time
  waiting,      // idle: it blocked without using CPU time
  out_of_memory,
  too_much_output,
  too_much_answered,
  undecided,  // answers to identical calls differ, so that they prove nothing
  no_token,
  not_compiled,
  missing
};

struct Answer {
  How how = How::missing;
  Numbers got;
  std::string detail = {};  // exception text, signal name, first error of the compiler, or a key of the texts
  /// Named numbers. For `unusable`, the numbers that the text needs. For `out_of_time`, the number of calls of each
  /// student function so far; the last entry is the function that was called last.
  std::vector<std::pair<std::string, long>> counts = {};
  double reference = 0;  // for out_of_time: CPU time (s) of the official solution for all calls of the test
  Numbers of = {};       // denominator of each number in `got` that is a fraction, 0 for other numbers
};

/// The numbers to compare with a case's `expected`, and the denominators of fractions, as in Answer.
struct Found {
  Numbers got, of;
  Found(Numbers numbers, Numbers all = {}) : got(std::move(numbers)), of(std::move(all)) {}
};

/// True if the outcome is neither right nor wrong: the code reached a limit that depends on the machine, or its answers
/// cannot be measured.
inline bool ungraded(How how) {
  return how == How::out_of_time || how == How::waiting || how == How::too_much_answered || how == How::undecided;
}

}  // namespace coursework
