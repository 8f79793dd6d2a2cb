// Progress of long work: one line that renews itself on a terminal, plain lines elsewhere.
#pragma once

#include <chrono>
#include <string>

namespace crosscheck {

class Progress {
 public:
  /// total: how many steps of work there will be, for the estimate.
  explicit Progress(int total);
  ~Progress();
  /// Announces the step that begins now.
  void begin(const std::string& what);
  /// More work was found, or less.
  void expect(int more) { total_ += more; }
  void done();

 private:
  int total_, begun_ = 0;
  bool terminal_;
  std::chrono::steady_clock::time_point start_;
};

}  // namespace crosscheck
