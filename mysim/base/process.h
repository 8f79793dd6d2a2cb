// Other programs: started without a shell, run to their end with or without a time-out, or fed through their stdin.
#pragma once

#include <sys/resource.h>

#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace crosscheck {

// The environment of programs that Crosscheck starts.

/// The entries "NAME=value" for any program that Crosscheck starts: those of this program, but a locale that
/// exists everywhere (C.UTF-8: letters in UTF-8, points in numbers, English messages) and the time zone UTC, so that
/// its output does not depend on the terminal or job that started it. `extra` wins over both.
std::vector<std::string> program_environment(const std::vector<std::string>& extra = {});

/// The texts as exec and its kin take them, a null at the end; good as long as these texts.
std::vector<char*> c_strings(const std::vector<std::string>& texts);

/// User and system time together, s.
double cpu_seconds(const rusage& usage);

// Runs another program without a shell and hands back how it ended and what it wrote.

/// A program that cannot be started. what() names it.
struct CannotStart : std::runtime_error {
  CannotStart(const std::string& program, const std::string& why);
  std::string reason;  // the system's
};

struct ProgramResult {
  int status = 0;               // exit code; 128 + signal number if a signal ended it
  int signal = 0;               // that ended it; 0 when it exited by itself
  bool timed_out = false;       // only with a time-out, as the next two
  bool left_children = false;   // it ended, and processes of it did not, which were killed
  bool killed_watcher = false;  // it ended the process that watches over it: what it left behind may go on
  double cpu_seconds = 0;       // user and system time of the program and of the children it waited for
  std::string out, err;         // all of stdout and of stderr
};

/// Runs argv[0] (a path, or looked up in PATH) in the folder cwd with stdin empty, in the environment of
/// program_environment(extra_env), until it has ended and its output is closed.
/// With a timeout (s) it is not trusted to behave: it may hang, crash, chatter, detach itself, or leave children
/// behind. When it has ended, or time is up, or this thread ends, all that descends from it is killed: it runs in a pid
/// namespace of its own where the kernel allows that, elsewhere under a process that orphans are handed to. Only the
/// last 64 KiB of stdout and of stderr are kept. Throws CannotStart.
ProgramResult run_program(const std::vector<std::string>& argv, const std::filesystem::path& cwd,
                          const std::vector<std::string>& extra_env = {}, std::optional<double> timeout = {});

/// Runs it with the stdin, stdout and stderr of this program, and hands back its exit status, as above. Throws
/// CannotStart.
int run_in_terminal(const std::vector<std::string>& argv);

/// Whether a program of this name is in PATH.
bool on_path(const std::string& program);

/// The end of what a program said.
std::string last_lines(const std::string& text, int count);

// A program that is fed through its stdin while it runs.

class ProcessWithInput {
 public:
  /// Starts argv[0] (looked up in PATH); what it says on stdout is lost. Throws std::runtime_error if that is not
  /// possible.
  explicit ProcessWithInput(const std::vector<std::string>& argv);
  /// Ends it, where its input was not closed.
  ~ProcessWithInput();
  ProcessWithInput(const ProcessWithInput&) = delete;
  ProcessWithInput& operator=(const ProcessWithInput&) = delete;

  /// False where it takes no more, as it has ended.
  bool write_input(const void* data, size_t bytes);
  /// Says that this was all, waits, and hands back its exit status and its stderr.
  ProgramResult finish();

 private:
  pid_t child_ = 0;
  int input_ = -1, err_ = -1;
};

}  // namespace crosscheck
