// Child processes, started without a shell and run to their end, with or without a time limit.
#pragma once

#include <sys/resource.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace crosscheck {

/// Environment ("NAME=value") of all programs that Crosscheck starts: the environment of this program, with locale
/// C.UTF-8 and time zone UTC, so that output does not depend on the terminal or job. `extra` takes precedence.
std::vector<std::string> program_environment(const std::vector<std::string>& extra = {});

/// Null-terminated pointers to the texts, as exec*() requires.
std::vector<char*> c_strings(const std::vector<std::string>& texts);

/// Sum of user and system time (s).
double cpu_seconds(const rusage& usage);

/// A program that cannot be started. what() names it.
struct CannotStart : std::runtime_error {
  CannotStart(const std::string& program, const std::string& why);
  std::string reason;  // the system's message
};

struct ProgramResult {
  int status = 0;               // exit code, or 128 + signal number
  int signal = 0;               // signal that ended the program; 0 if it exited
  bool timed_out = false;       // set only with a time limit, like the next two members
  bool left_children = false;   // the program ended before its children, which were killed
  bool killed_watcher = false;  // the program killed its watcher: its children may still run
  double cpu_seconds = 0;       // user and system time of the program and of the children it waited for
  std::string out, err;         // stdout and stderr
};

/// Runs argv[0] (a path, or a name in PATH) in the folder cwd, with empty stdin and program_environment(extra_env),
/// until it has ended and its output is closed. Throws CannotStart.
/// A program with a timeout (s) is not trusted: it may hang, crash, write without end, detach itself or leave children.
/// It runs in its own pid namespace if the kernel permits, otherwise under a subreaper. All its descendants are killed
/// when it ends, at the time limit, and when the calling thread ends. Only the last 64 KiB of stdout and of stderr are
/// kept.
ProgramResult run_program(const std::vector<std::string>& argv, const std::filesystem::path& cwd,
                          const std::vector<std::string>& extra_env = {}, std::optional<double> timeout = {});

/// An untrusted program that answers requests line by line, from stdin to stdout. The destructor closes its stdin and
/// kills all its descendants after 0.2 s.
class LineServer {
 public:
  LineServer(const std::vector<std::string>& argv, const std::filesystem::path& cwd);
  ~LineServer();
  LineServer(const LineServer&) = delete;
  LineServer& operator=(const LineServer&) = delete;

  struct Answer {
    std::string line;  // begins with '{'; empty if the program ended, timed out, or wrote 64 KiB without such a line
    bool timed_out = false;
    double cpu_seconds = 0;  // user and system time of the program between request and answer
    std::string err;         // stderr between request and answer
  };
  /// Sends the line and waits at most `seconds` for a line that begins with '{', skipping others. The server is
  /// unusable after an answer without a line.
  Answer ask(const std::string& line, double seconds);

  /// False in a forked process: two processes must not share a pipe.
  bool is_mine() const;

 private:
  struct Process;
  std::unique_ptr<Process> process_;
};

/// Runs a program on this program's stdin, stdout and stderr; returns its status as in ProgramResult. Throws
/// CannotStart.
int run_in_terminal(const std::vector<std::string>& argv);

bool on_path(const std::string& program);

std::string last_lines(const std::string& text, int count);

/// Ends all children of this process, and the orphans it adopts as a subreaper, by SIGTERM and, after the grace period,
/// by SIGKILL. Gives up ten seconds later. Allocates nothing.
void end_children(std::chrono::milliseconds grace);

}  // namespace crosscheck
