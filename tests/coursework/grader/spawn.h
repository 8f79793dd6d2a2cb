// Runs one program under limits, with a supervisor between it and the grader, and says how it ended.
#pragma once

#include <linux/filter.h>
#include <sys/resource.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/coursework/grader/sandbox.h"

namespace coursework {

// The process between the grader and the program: it starts the program, waits for it, and leaves nothing of it behind.

/// All that is needed after fork, made before it: the grader has threads, so that nothing may be allocated then.
struct ChildSetup {
  char* const* command;
  char* const* environment;
  const char* folder;        // it starts there
  unsigned user;             // it runs under this user and group; 0: under ours
  const sock_fprog* filter;  // null: none
  const int* descriptors;    // these become 0, 1, 2, ...; all others are closed
  int count;
  int report;  // a ChildStatus is written here
  rlim_t cpu, memory, file, processes;
};

struct ChildStatus {
  const char* failed = nullptr;  // what could not be done (a literal of ours), with errno in `error`; null: it ran
  int error = 0;
  int status = 0;  // as wait gives it
  rusage used{};
};

/// Runs in a process of its own, with SIGTERM and SIGCHLD blocked; SIGTERM stops the program. When the program has
/// ended, its descendants are killed, and all processes of `user`.
[[noreturn]] void supervise(const ChildSetup& setup);

// The function that runs a program under limits; the sandboxes differ in its options.

struct SpawnOptions {
  std::vector<std::string> command, environment;  // environment as NAME=value
  std::filesystem::path folder;                   // it starts there
  unsigned user = 0;                              // it runs under this user and group; 0: under ours
  std::string filter = {};                        // see filter_program(); empty: none
  std::vector<int> passed = {};                   // descriptors that it gets as 4, 5, ...
  std::string input = {};
  Limits limits = {};
  long processes = 0;  // that its user may have at once, itself included
};

struct ProcessResult {
  int status = 0;                                                 // as wait gives it
  rusage used{};                                                  // by all its processes
  bool wall = false, idle = false, output = false, full = false;  // stopped by us; full: of answers
  std::string answers, captured_output;
};

/// Throws std::runtime_error where it cannot be started.
ProcessResult spawn(const SpawnOptions& start);

/// By the order that sandbox.h gives. `shell`: exit codes from 129 on are signals, as bwrap and shells report them.
End classify(ProcessResult ended, const Limits& limits, bool shell);

}  // namespace coursework
