// Runs a program under limits and under a supervisor process, and reports how it ended.
#pragma once

#include <linux/filter.h>
#include <sys/resource.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "tests/coursework/grader/sandbox.h"

namespace coursework {

// The supervisor is a process between the grader and the program. It starts the program, waits for it, and cleans up.

/// Data for the child, prepared before fork(): the grader has threads, so the child must not allocate.
struct ChildSetup {
  char* const* command;
  char* const* environment;
  const char* folder;        // working directory
  unsigned user;             // user and group of the program; 0 for ours
  const sock_fprog* filter;  // null for no filter
  const int* descriptors;    // become 0, 1, 2, ... in the program; all others are closed
  int count;
  int report;  // descriptor to which a ChildStatus is written
  int lock;    // descriptor that the supervisor keeps open until it ends, or -1
  rlim_t cpu, memory, file, processes;
};

struct ChildStatus {
  const char* failed = nullptr;  // operation that failed (a literal), with errno in `error`; null if the program ran
  int error = 0;
  int status = 0;  // as returned by wait()
  rusage used{};
};

/// The supervisor's main function, called in a separate process with SIGTERM and SIGCHLD blocked. SIGTERM stops the
/// program. After the program's end, kills its descendants and all processes of `user`.
[[noreturn]] void supervise(const ChildSetup& setup);

class Descriptor {
 public:
  explicit Descriptor(int fd = -1) : fd_(fd) {}
  ~Descriptor() { reset(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(fd_, other.fd_);
    return *this;
  }
  void reset();
  int get() const { return fd_; }

 private:
  int fd_;
};

/// A pipe whose descriptors are above those that programs get. Throws std::runtime_error if no descriptors are left.
struct Pipe {
  Descriptor from, to;
  Pipe();
};

struct SpawnOptions {
  std::vector<std::string> command, environment;  // environment as NAME=value
  std::filesystem::path folder;                   // working directory
  unsigned user = 0;                              // user and group of the program; 0 for ours
  int lock = -1;                                  // reserves the user until the supervisor has cleaned up, or -1
  std::string filter = {};                        // see filter_program(); empty for no filter
  std::vector<int> passed = {};                   // descriptors that the program receives as 4, 5, ...
  std::string input = {};
  Limits limits = {};
  long processes = 0;  // limit on concurrent processes of the program's user, including the program
};

struct ProcessResult {
  int status = 0;                                                 // as returned by wait()
  rusage used{};                                                  // sum over all processes
  bool wall = false, idle = false, output = false, full = false;  // stopped by us; `full`: too many answers
  std::string answers, captured_output;
};

/// Throws std::runtime_error if the program cannot be started.
ProcessResult spawn(const SpawnOptions& start);

/// Determines the outcome in the order given in sandbox.h. `shell`: exit codes from 129 on are signals, as reported by
/// bwrap and shells.
End classify(ProcessResult ended, const Limits& limits, bool shell);

}  // namespace coursework
