// CPU time of the calling thread: what the work cost, whatever else the machine was doing.
#pragma once

namespace crosscheck {

/// Adds up the thread's CPU time between start() and stop(); one that does not run says 0.
class CpuClock {
 public:
  explicit CpuClock(bool runs = true) : runs_(runs) {}
  void start();
  void stop();
  double seconds() const { return total_; }

 private:
  bool runs_;
  double begin_ = 0, total_ = 0;
};

}  // namespace crosscheck
