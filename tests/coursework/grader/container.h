// Runs a program and all that it starts as in a small container, and measures what they take.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace coursework {

struct Container {
  double cpus = 0.5;
  long memory = 768;   // MB
  double time = 600;   // s
  bool closed = true;  // no new namespaces: unshare and setns give EPERM, clone with such flags too, clone3 ENOSYS
};

struct Usage {
  int status = 0;   // exit status, or 128 and the signal
  double time = 0;  // s, that it would take with so many CPUs: wall time, or CPU time over CPUs where that is more
  long memory = 0;  // MB, the largest sum over all processes of what each has resident, shared pages shared out
  bool too_late = false, too_large = false;  // stopped for that
};

/// Output goes to `log`. All its processes share one CPU, and memory is looked at twenty times a second: what comes and
/// goes between two looks is not seen. Afterwards none of them is left. Throws std::runtime_error where it cannot
/// start.
Usage run_in_container(const std::vector<std::string>& command, const std::vector<std::string>& environment,
                       const std::filesystem::path& log, const Container& container);

}  // namespace coursework
