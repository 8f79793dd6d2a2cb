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
  bool closed = true;  // forbid new namespaces: unshare, setns and clone fail with EPERM, clone3 with ENOSYS
};

struct Usage {
  int status = 0;   // exit status, or 128 plus the signal
  double time = 0;  // s, with the given number of CPUs: the larger of wall time and (CPU time / CPUs)
  long memory = 0;  // MB, maximum of the resident memory of all processes; shared pages are divided among them
  bool too_late = false, too_large = false;  // reason why the program was stopped
};

/// Runs the command with its output in `log`. All processes share one CPU. Memory is sampled twenty times a second, so
/// peaks between two samples are missed. None of the processes remains afterwards. Throws std::runtime_error if the
/// command cannot start.
Usage run_in_container(const std::vector<std::string>& command, const std::vector<std::string>& environment,
                       const std::filesystem::path& log, const Container& container);

}  // namespace coursework
