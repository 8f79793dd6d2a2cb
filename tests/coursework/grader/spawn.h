// Runs one program under limits, with a supervisor between it and the grader, and reports how it ended.
#pragma once

#include <linux/filter.h>
#include <sys/resource.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "tests/coursework/grader/sandbox.h"

namespace coursework {

// The process between the grader and the program: starts the program, waits for it, and cleans up after it.

/// Data for the child, prepared before fork(): the grader has threads, so the child must not allocate.
struct ChildSetup {
  char* const* command;
  char* const* environment;
  const char* folder;        // working directory
  unsigned user;             // user and group of the program; 0: ours
  const sock_fprog* filter;  // null: none
  const int* descriptors;    // become 0, 1, 2, ...; all others are closed
  int count;
  int report;  // descriptor to which a ChildStatus is written
  int lock;    // descriptor that the supervisor holds open until it ends; -1: none
  rlim_t cpu, memory, file, processes;
};

struct ChildStatus {
  const char* failed = nullptr;  // operation that failed (a literal of ours), with errno in `error`; null: it ran
  int error = 0;
  int status = 0;  // as returned by wait()
  rusage used{};
};

/// Runs in a separate process, with SIGTERM and SIGCHLD blocked; SIGTERM stops the program. After the program's end,
/// kills its descendants and all processes of `user`.
[[noreturn]] void supervise(const ChildSetup& setup);

// Runs a program under limits; the sandboxes differ in its options.

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

/// Both descriptors are above those that programs get. Throws std::runtime_error if there are too many.
struct Pipe {
  Descriptor from, to;
  Pipe();
};

struct SpawnOptions {
  std::vector<std::string> command, environment;  // environment as NAME=value
  std::filesystem::path folder;                   // working directory
  unsigned user = 0;                              // user and group of the program; 0: ours
  int lock = -1;                                  // reserves the user until the supervisor has cleaned up; -1: none
  std::string filter = {};                        // see filter_program(); empty: none
  std::vector<int> passed = {};                   // descriptors that it receives as 4, 5, ...
  std::string input = {};
  Limits limits = {};
  long processes = 0;  // limit on concurrent processes of its user, including itself
};

struct ProcessResult {
  int status = 0;                                                 // as returned by wait()
  rusage used{};                                                  // for all its processes
  bool wall = false, idle = false, output = false, full = false;  // stopped by us; full: too many answers
  std::string answers, captured_output;
};

/// Throws std::runtime_error if the program cannot be started.
ProcessResult spawn(const SpawnOptions& start);

/// Decides the outcome in the order given in sandbox.h. `shell`: exit codes from 129 on are signals, as bwrap and
/// shells report them.
End classify(ProcessResult ended, const Limits& limits, bool shell);

}  // namespace coursework
