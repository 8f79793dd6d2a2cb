// This process: its CPU time, the memory available to it, and a supervisor that cleans up after it.
#pragma once

#include <functional>
#include <string>

namespace crosscheck {

/// Accumulates the calling thread's CPU time between start() and stop(), or stays at 0 if constructed with false.
/// Subtracts the duration of the clock readings (about 0.4 us, longer than many steps), but leaves at least 1 ns.
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

/// CPU time of the work (s).
template <class Work>
double cpu_time_of(const Work& work) {
  CpuClock clock;
  clock.start();
  work();
  clock.stop();
  return clock.seconds();
}

/// Memory available to this process (bytes): MemAvailable, or less if a control group or the address-space limit leaves
/// less. Infinite if unknown.
double free_memory();

/// Runs the work in a child process and forwards SIGINT, SIGTERM and SIGHUP to it. When the child has ended, ends all
/// its descendants, removes temporary folders of dead processes, and cleans up unfinished results (see
/// register_output()), none of it in a signal handler. Then returns the child's exit status, or ends the way the child
/// ended. If this supervisor is killed, the child is killed too, and the next start cleans up. If it cannot fork, it
/// runs the work in this process. Prints `when_interrupted` on standard error if a signal ends the work. Must be called
/// first in main().
int run_supervised(const std::function<int()>& work, const std::string& when_interrupted = "");

/// Registers a result folder for clean-up if this process is killed. No effect without a supervisor.
void register_output(const std::string& folder);

}  // namespace crosscheck
