// The process between the grader and the program: it starts the program, waits for it, and leaves nothing of it behind.
#pragma once

#include <linux/filter.h>
#include <sys/resource.h>

namespace coursework {

/// All that is needed after fork, made before it: the grader has threads, so that nothing may be allocated then.
struct Plan {
  char* const* command;
  char* const* environment;
  const char* folder;        // it starts there
  unsigned user;             // it runs under this user and group; 0: under ours
  const sock_fprog* filter;  // null: none
  const int* descriptors;    // these become 0, 1, 2, ...; all others are closed
  int count;
  int report;  // a Report is written here
  rlim_t cpu, memory, file, processes;
};

struct Report {
  const char* failed = nullptr;  // what could not be done (a literal of ours), with errno in `error`; null: it ran
  int error = 0;
  int status = 0;  // as wait gives it
  rusage used{};
};

/// Runs in a process of its own, with SIGTERM and SIGCHLD blocked; SIGTERM stops the program. When the program has
/// ended, its descendants are killed, and all processes of `user`.
[[noreturn]] void supervise(const Plan& plan);

}  // namespace coursework
