// Runs a program and its descendants in an emulation of a small container, and measures the time and memory used.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace coursework {

struct Container {
  double cpus = 0.5;
  long memory = 768;   // MB
  double time = 600;   // s
  bool closed = true;  // no new namespaces: unshare, setns and clone fail with EPERM, clone3 with ENOSYS
};

struct Usage {
  int status = 0;   // exit status, or 128 plus the signal
  double time = 0;  // s, with the given number of CPUs: the larger of wall time and CPU time over CPUs
  long memory = 0;  // MB, maximum of the sum of resident memory over all processes, with shared pages split among them
  bool too_late = false, too_large = false;  // stopped for this reason
};

/// Output goes to `log`. All processes share one CPU, and memory is sampled twenty times a second, so peaks between two
/// samples are missed. None of the processes remains afterwards. Throws std::runtime_error if it cannot start.
Usage run_in_container(const std::vector<std::string>& command, const std::vector<std::string>& environment,
                       const std::filesystem::path& log, const Container& container);

}  // namespace coursework
