// This process: its CPU time, the memory left to it, and the parent that tidies up after it.
#pragma once

#include <functional>
#include <string>

namespace crosscheck {

// CPU time of the calling thread: what the work cost, whatever else the machine was doing.

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

/// CPU time of the work, s.
template <class Work>
double cpu_time_of(const Work& work) {
  CpuClock clock;
  clock.start();
  work();
  clock.stop();
  return clock.seconds();
}

/// Bytes that this process can still take: what the system says is available (MemAvailable), less where a control group
/// or a limit of the process's address space allows less. Infinite where nothing is known.
double free_memory();

// A program in two processes: one works, the other sees to it that nothing is left when the first has ended, however.

/// Does the work in a child process, hands SIGINT, SIGTERM and SIGHUP on to it, and returns its exit status, or ends as
/// it ended. Before that all that descends from the child is ended too, temporary folders of processes that are gone
/// are removed, and what they left of unfinished results (see register_output()). Nothing of this runs in a signal
/// handler. A supervisor that is killed takes the child with it; what is left then, the next start removes. To be
/// called first in main(). Where no process can be made, the work is done in this one. If a signal ends the work,
/// `when_interrupted` is reported on standard error unless it is empty.
int run_supervised(const std::function<int()>& work, const std::string& when_interrupted = "");

/// Names a folder for results that must be seen to where this process is killed. Nothing where there is no supervisor.
void register_output(const std::string& folder);

}  // namespace crosscheck
