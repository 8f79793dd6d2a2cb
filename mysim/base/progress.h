// Progress of long work on standard error, shown after two seconds. On a terminal, one line is rewritten in place;
// elsewhere, new lines are printed.
#pragma once

#include <sys/types.h>

#include <memory>
#include <string>

namespace crosscheck {

struct ProgressSnapshot {
  int begun = 0, total = 0;  // steps, including the current one; a single step is not numbered
  double part = 0;           // finished fraction of the current step, 0 to 1
  double elapsed = 0;        // s, since the start
  double expected = 0;       // s, estimated duration of the current step; 0 if unknown
  double in_step = 0;        // s, since the start of the step
  std::string what;
};
/// "[3/12] what (34 s, about 2 min left)". The remaining time follows from the finished fraction, or from the
/// expected duration.
std::string progress_line(const ProgressSnapshot& seen);
/// "34 s", "12 min", "3.4 h", "5 days", "1e+05 years".
std::string format_duration(double seconds);

/// Displays progress from its own thread; the working thread only stores a number.
class Progress {
 public:
  /// `total`: number of steps.
  explicit Progress(int total);
  ~Progress();
  /// Begins the next step; `seconds` is its expected duration, if known.
  void begin(const std::string& what, double seconds = 0);
  /// Sets the finished fraction of the current step, 0 to 1. Costs one store.
  void part(double done);
  /// Adds to the number of steps.
  void expect(int more);
  /// Erases the line from the terminal until the next step begins.
  void done();
  /// Calls fork() while the display thread sleeps. If it held a lock at that time (e.g. of the allocator), nobody would
  /// release this lock in the child.
  pid_t fork();

 private:
  struct Display;
  std::unique_ptr<Display> display_;
};

}  // namespace crosscheck
