// CPU time of the calling thread: what the work cost, whatever else the machine was doing.
#pragma once

namespace crosscheck {

/// Adds up the thread's CPU time between start() and stop().
class CpuClock {
 public:
  void start();
  void stop();
  double seconds() const { return total_; }

 private:
  double begin_ = 0, total_ = 0;
};

}  // namespace crosscheck
