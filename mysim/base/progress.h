// Progress of long work on standard error: one renewed line on a terminal, plain lines elsewhere, nothing in the first
// two seconds.
#pragma once

#include <sys/types.h>

#include <memory>
#include <string>

namespace crosscheck {

struct ProgressSnapshot {
  int begun = 0, total = 0;  // steps of work, the current one included; a single step has no number
  double part = 0;           // finished part of the current step, 0 to 1
  double elapsed = 0;        // s, since the start
  double expected = 0;       // s, estimated duration of the current step; 0: unknown
  double in_step = 0;        // s, since the start of the step
  std::string what;
};
/// "[3/12] what (34 s, about 2 min left)": the remaining time from the finished part, otherwise from the estimate.
std::string progress_line(const ProgressSnapshot& seen);
/// "34 s", "12 min", "3.4 h", "5 days", "1e+05 years".
std::string format_duration(double seconds);

/// A thread of its own writes the line; the working thread only stores a number.
class Progress {
 public:
  /// total: number of steps of work, for the estimate.
  explicit Progress(int total);
  ~Progress();
  /// Begins the next step; `seconds` is its expected duration, if known.
  void begin(const std::string& what, double seconds = 0);
  /// Sets the finished part of the current step, 0 to 1. Costs one store.
  void part(double done);
  /// Adds to the number of steps.
  void expect(int more);
  /// Erases the line from the terminal until the next step begins.
  void done();
  /// fork() while the thread sleeps: otherwise it could hold a lock, for example of the allocator, that would stay
  /// closed in the child.
  pid_t fork();

 private:
  struct Display;
  std::unique_ptr<Display> display_;
};

}  // namespace crosscheck
