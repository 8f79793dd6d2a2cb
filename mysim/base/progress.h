// Progress of long work on standard error: one line that renews itself on a terminal, plain lines elsewhere; nothing in
// the first two seconds.
#pragma once

#include <sys/types.h>

#include <memory>
#include <string>

namespace crosscheck {

/// The progress at a moment.
struct ProgressSnapshot {
  int begun = 0, total = 0;  // steps of work; of one alone no number is shown
  double part = 0;           // of the step that is going on, 0 to 1
  double elapsed = 0;        // s, since the beginning
  double expected = 0;       // s, of the step that is going on, as estimated beforehand; 0: unknown
  double in_step = 0;        // s, since the step began
  std::string what;
};
/// "[3/12] what (34 s, about 2 min left)": the time left from what is done so far, else from the estimate,
/// else nothing.
std::string progress_line(const ProgressSnapshot& seen);
/// "34 s", "12 min", "3.4 h", "5 days", "1e+05 years".
std::string format_duration(double seconds);

/// A thread of its own writes the line a few times a second; the working thread only stores a number.
class Progress {
 public:
  /// total: how many steps of work there will be, for the estimate.
  explicit Progress(int total);
  ~Progress();
  /// Announces the step that begins now; `seconds`: how long it will take, where that is known.
  void begin(const std::string& what, double seconds = 0);
  /// Sets the finished part of the current step, 0 to 1. Costs a store.
  void part(double done);
  /// More work was found, or less.
  void expect(int more);
  /// Takes the line from the terminal: what is printed afterwards stands alone. The next step shows it again.
  void done();
  /// fork() at a moment when the thread sleeps: else it may hold a lock, of an allocator for one, that nobody would
  /// ever open in the child.
  pid_t fork();

 private:
  struct Display;
  std::unique_ptr<Display> display_;
};

}  // namespace crosscheck
