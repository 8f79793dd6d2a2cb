// Sandboxes for untrusted programs. sandbox.cpp has the table of sandboxes.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace coursework {

struct Limits {
  double cpu = 2, wall = 5;  // s; cpu is for all its processes, and each alone is stopped at the next full second
  double idle = 30;          // s in which none of its processes runs or waits for a processor or a disk
  long memory = 1024;        // MB of address space, for each process
  long processes = 0;        // number that it may start; 0: none, only threads
  long threads = 64;         // including the main one; applies if no process may be started
  long output = 4096;        // kB of captured_output
  long answers = 4096;       // kB on the answers' pipe
  long file = 16;            // MB, for each file that it writes
};

/// If the grader runs as root, the program runs under a separate user and on copies of `readable`, so that our folders
/// can be closed to all others. Protected folders must be closed, because in a sandbox without namespaces nothing else
/// hides them (see sees()). The program starts in `writable`, or in an empty private folder, with only PATH, LANG, HOME
/// and TMPDIR as its environment. If it may not start processes, it has no /proc in sandbox bwrap.
struct Job {
  std::vector<std::string> command;                  // absolute paths
  std::vector<std::filesystem::path> readable = {};  // folders that it sees in addition to the system's, read only
  std::filesystem::path writable = {};               // one folder that it may write to; empty: in sandbox bwrap its own
                                                     // /tmp, which is bounded; in sandbox uid it cannot make any file.
                                                     // Afterwards it holds plain files and folders of ours only
  std::string input = {};                            // its standard input
  Limits limits = {};
  std::vector<int> passed = {};  // descriptors that it gets as 4, 5, ...
};

/// Outcome, decided in this order: stopped by us (wall, idle, output, answers); CPU time exceeded (cpu); memory: it
/// failed and reported so (a last line `memory` on descriptor 3, or "bad_alloc" or "out of memory" in the
/// captured_output), or the kernel killed it while it used most of its limit; a signal; an exit code.
struct End {
  enum class How { exited, signal, cpu, wall, idle, memory, output, answers } how = How::exited;
  int code = 0;                 // exit status, or the signal
  std::string answers;          // data from descriptor 3
  std::string captured_output;  // beginning of stdout and stderr
  double cpu = 0;               // s, used by all its processes
};

class Sandbox {
 public:
  virtual ~Sandbox() = default;
  virtual std::string_view name() const = 0;
  virtual std::string_view says() const = 0;  // its protection, in one sentence
  /// Runs the job to its end or to a limit; afterwards none of its processes remains, and no file outside `writable`.
  /// Thread-safe. Throws std::runtime_error if the job cannot be started (never for what the program does).
  virtual End run(const Job& job) const = 0;
};

/// The first sandbox whose probe succeeds; `named` forces one. If none is available and `unsafe` is false, throws
/// std::runtime_error with each sandbox's reason and the meaning of --no-sandbox.
std::unique_ptr<Sandbox> choose_sandbox(const std::string& named, bool unsafe);

/// The sandbox of this name, including bare, without a probe, to continue an earlier choice. Throws std::runtime_error
/// if there is none.
std::unique_ptr<Sandbox> sandbox_named(const std::string& name);

/// Tests by trial whether a program in this sandbox can read the folder or file. The grader checks tests, solution,
/// secret and other people's submissions before it runs anything. Throws std::runtime_error if it gives no answer.
bool sees(const Sandbox& sandbox, const std::filesystem::path& secret);

// Available sandboxes, for the table in sandbox.cpp.

/// Bubblewrap: separate namespaces.
std::unique_ptr<Sandbox> bwrap_sandbox();
/// A separate user per run, for root in a container that forbids namespaces.
std::unique_ptr<Sandbox> uid_sandbox();
/// Limits and the system-call filter only.
std::unique_ptr<Sandbox> bare_sandbox();

}  // namespace coursework
