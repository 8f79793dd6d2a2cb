// A case: a call of the student's code, and the right answer. Shared by the grader and by the hand-out's `check`:
// C++17, standard library only.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace coursework {

using Numbers = std::vector<double>;

/// One call of the student's code. The call's name and the layout of its numbers are those of the assignment's
/// calls_PART.cpp.
struct Case {
  std::string call;
  Numbers in;
  Numbers expected;      // row after row
  int columns = 1;       // numbers in a row
  double tolerance = 0;  // absolute, for each number
  std::string row;       // what a row is, a key of the texts: "step", "particle", "spring"
  std::string column;    // what its numbers are, a key of the texts: "state", "force"
  int plot_x = -1;       // column drawn along x; -1: the row's number times `row_size`
  int plot_y = -1;       // column drawn along y; -1: nothing to draw
  double row_size = 1;   // of a row along x, s where rows are steps
};

/// How a call of the student's code ended.
enum class How {
  answered,
  threw,
  unusable,  // what it gave back cannot be worked with: the calls around it say so
  crashed,
  recursion,    // it called itself until the stack was full
  out_of_time,  // of the processor's
  waiting,      // it did nothing any more
  out_of_memory,
  too_much_output,
  too_much_answered,
  undecided,  // it answers, but not the same when asked the same: what follows from its answers cannot be found
  no_token,
  not_compiled,
  missing
};

struct Answer {
  How how = How::missing;
  Numbers got;
  std::string detail = {};  // what was thrown, the signal's name, the compiler's first error, a key of the texts
  /// How often functions of the student's were called: the numbers that the text of an `unusable` needs; of an
  /// out_of_time each function so far, the one it was in last.
  std::vector<std::pair<std::string, long>> counts = {};
  double reference = 0;  // s, out_of_time: what the official solution needs for all calls of the test
  Numbers of = {};       // beside `got` where some are shares: how many all of them are; 0: no share
};

/// What stands beside a case's `expected`: the numbers, and of shares how many all are, as in Answer.
struct Found {
  Numbers got, of;
  Found(Numbers numbers, Numbers all = {}) : got(std::move(numbers)), of(std::move(all)) {}
};

/// Whether it is no answer of the student's, right or wrong: it ran into a limit of ours that depends on the machine,
/// or what it answers does not let itself be measured.
inline bool ungraded(How how) {
  return how == How::out_of_time || how == How::waiting || how == How::too_much_answered || how == How::undecided;
}

}  // namespace coursework
