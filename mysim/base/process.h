// Other programs: started without a shell, run to their end with or without a time-out, or fed through their stdin.
#pragma once

#include <fcntl.h>
#include <spawn.h>
#include <sys/types.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
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

// The two ends of a pipe, closed however the scope is left and never handed on to other programs.

struct Pipe {
  int read_end = -1, write_end = -1;  // -1: closed
  /// Throws std::runtime_error with the system's reason.
  Pipe() {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error(std::string("pipe: ") + std::strerror(errno));
    read_end = ends[0], write_end = ends[1];
  }
  ~Pipe() { close_end(read_end), close_end(write_end); }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  static void close_end(int& end) {
    if (end >= 0) close(end);
    end = -1;
  }
};

// Runs a program that is not trusted to behave: it may hang, crash, chatter, or leave children behind.

struct ProcessResult {
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
ProcessResult run_process(const std::vector<std::string>& argv, double timeout);

// Starting a program without a shell, and its end.

/// The standard files of a program at its start.
struct FileActions {
  posix_spawn_file_actions_t list;
  FileActions() { posix_spawn_file_actions_init(&list); }
  ~FileActions() { posix_spawn_file_actions_destroy(&list); }
  FileActions(const FileActions&) = delete;
  FileActions& operator=(const FileActions&) = delete;
};

/// Starts argv[0] (looked up in PATH) in the environment of program_environment(extra_env). Throws std::runtime_error
/// that names it.
pid_t spawn(const std::vector<std::string>& argv, const FileActions& actions,
            const std::vector<std::string>& extra_env = {});

/// Waits for it: its exit code, or 128 + signal number if a signal ended it.
int wait_for(pid_t child);

// Runs another program without a shell and hands back its exit status and all it wrote.

struct ProgramResult {
  int status = 0;   // exit code; 128 + signal number if a signal ended it
  std::string err;  // all of stderr
  std::string out;  // all of stdout
};

/// Runs argv[0] (looked up in PATH) in the folder cwd with stdin empty, in the environment of
/// program_environment(extra_env). Throws std::runtime_error if the program cannot be started.
ProgramResult run_program(const std::vector<std::string>& argv, const std::filesystem::path& cwd,
                          const std::vector<std::string>& extra_env = {});

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
