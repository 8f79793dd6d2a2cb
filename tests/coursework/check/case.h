// A call of the student's code and the expected answer. Shared by the grader and the hand-out's `check`: C++17,
// standard library only.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace coursework {

using Numbers = std::vector<double>;

/// The assignment's calls_PART.cpp defines the call's name and the layout of its numbers.
struct Case {
  std::string call;
  Numbers in;
  Numbers expected;      // row by row
  int columns = 1;       // numbers in a row
  double tolerance = 0;  // absolute, for each number
  std::string row;       // kind of a row, a key of the texts: "step", "particle", "spring"
  std::string column;    // kind of its numbers, a key of the texts: "state", "force"
  int plot_x = -1;       // column drawn along x; -1: the row's number times `row_size`
  int plot_y = -1;       // column drawn along y; -1: nothing to draw
  double row_size = 1;   // extent of a row along x; s if rows are steps
};

enum class How {
  answered,
  threw,
  unusable,  // its return value cannot be used, as the calls around it report
  crashed,
  recursion,    // infinite recursion: the stack overflowed
  out_of_time,  // CPU time
  waiting,      // idle: it blocked without using CPU time
  out_of_memory,
  too_much_output,
  too_much_answered,
  undecided,  // its answers to identical calls differ, so that nothing can be inferred from them
  no_token,
  not_compiled,
  missing
};

struct Answer {
  How how = How::missing;
  Numbers got;
  std::string detail = {};  // exception text, signal name, first error of the compiler, or a key of the texts
  /// Names with numbers. unusable: the numbers that its text needs. out_of_time: the number of calls of each student
  /// function so far, with the function called last at the end.
  std::vector<std::pair<std::string, long>> counts = {};
  double reference = 0;  // s, for out_of_time: CPU time of the official solution for all calls of the test
  Numbers of = {};       // denominators of those numbers in `got` that are shares; 0: not a share
};

/// The numbers to compare with a case's `expected`, and the denominators of shares, as in Answer.
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
