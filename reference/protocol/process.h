// Runs a program that is not trusted to behave: it may hang, crash, chatter, or leave children behind.
#pragma once

#include <string>
#include <vector>

namespace crosscheck {

struct ProcessEnd {
  bool timed_out = false;
  int signal = 0;              // that ended it; 0 when it exited by itself
  int status = 0;              // exit status; of no meaning after a signal
  bool left_children = false;  // it ended, and something of it kept its output open
  double cpu_seconds = 0;      // user and system time of the program and of the children it waited for
  std::string out, err;        // the last 64 KiB of each
};

/// Starts argv[0] (a path) in a process group of its own, with stdin from /dev/null, and waits for at most `timeout`
/// (s). When it has ended, or time is up, the whole group is killed. It is killed too when this thread ends first.
/// Throws std::runtime_error with the system's reason when it cannot be started.
ProcessEnd run_process(const std::vector<std::string>& argv, double timeout);

}  // namespace crosscheck
