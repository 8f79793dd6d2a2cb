// Sandboxes run programs that nobody trusts. The table of sandboxes is in sandbox.cpp.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace coursework {

struct Limits {
  double cpu = 2, wall = 5;  // s; cpu is that of all its processes, and each alone is stopped at the next full second
  double idle = 30;          // s without any of its processes running or waiting for a processor or a disk
  long memory = 1024;        // MB of address space, of each process
  long processes = 0;        // that it may start; 0: none, only threads
  long threads = 64;         // the main one included, where no process may be started
  long output = 4096;        // kB of captured_output
  long answers = 4096;       // kB on the answers' pipe
  long file = 16;            // MB, of any file that it writes
};

/// Where the grader runs as root, the program runs under a user of its own and on copies of `readable`, so that folders
/// of ours may be closed to all others. What it must never see has to be closed: in a sandbox without namespaces
/// nothing else keeps it out (see sees()). It starts in `writable`, else in an empty folder of its own, with PATH,
/// LANG, HOME and TMPDIR as its only environment. Without processes to start it has no /proc in sandbox bwrap.
struct Job {
  std::vector<std::string> command;                  // absolute paths
  std::vector<std::filesystem::path> readable = {};  // folders that it sees beside the system's own, read only
  std::filesystem::path writable = {};               // one folder that it may write to; empty: in sandbox bwrap its own
                                                     // /tmp, which is bounded; in sandbox uid it cannot make any file.
                                                     // Afterwards it holds plain files and folders of ours only
  std::string input = {};                            // its standard input
  Limits limits = {};
};

/// What decides, in this order: our own stop (wall, idle, output, answers); time used (cpu); memory: it ended badly and
/// said so (a last line `memory` on descriptor 3, or "bad_alloc" or "out of memory" in the captured_output), or the
/// kernel killed it while it held most of its limit; a signal; an exit code.
struct End {
  enum class How { exited, signal, cpu, wall, idle, memory, output, answers } how = How::exited;
  int code = 0;                 // exit status, or the signal
  std::string answers;          // what came on descriptor 3
  std::string captured_output;  // the first of stdout and stderr
  double cpu = 0;               // s, used by all its processes
};

class Sandbox {
 public:
  virtual ~Sandbox() = default;
  virtual std::string_view name() const = 0;
  virtual std::string_view says() const = 0;  // what it keeps out, one sentence
  /// Runs it to its end or to a limit; afterwards no process of it is left, and no file outside `writable`. Many
  /// threads may run jobs at once. Throws std::runtime_error where the job cannot be started at all (never for what the
  /// program does).
  virtual End run(const Job& job) const = 0;
};

/// The first sandbox whose probe succeeds; `named` forces one. Throws std::runtime_error that says what each sandbox
/// lacks and what --no-sandbox means, where none can be had and `unsafe` is false.
std::unique_ptr<Sandbox> choose_sandbox(const std::string& named, bool unsafe);

/// The sandbox of that name, or bare, as it is: for those who carry on what was chosen before. Throws
/// std::runtime_error where there is none.
std::unique_ptr<Sandbox> sandbox_named(const std::string& name);

/// Whether a program in this sandbox can read the folder or file (tried, not guessed). The grader asks it of tests,
/// solution, secret and other people's submissions before it runs anything.
bool sees(const Sandbox& sandbox, const std::filesystem::path& secret);

// The sandboxes that there are, for the table in sandbox.cpp.

/// Bubblewrap: namespaces of its own.
std::unique_ptr<Sandbox> bwrap_sandbox();
/// Another user per run, for root in a container that forbids namespaces.
std::unique_ptr<Sandbox> uid_sandbox();
/// Limits and the filter of system calls only.
std::unique_ptr<Sandbox> bare_sandbox();

}  // namespace coursework
