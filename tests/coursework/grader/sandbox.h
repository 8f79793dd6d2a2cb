// Sandboxes for untrusted programs. sandbox.cpp has the table of sandboxes.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace coursework {

struct Limits {
  // s; cpu: sum over all processes; each process is also stopped when its own CPU time reaches the next full second
  double cpu = 2, wall = 5;
  double idle = 30;     // s during which no process of the program runs or waits for a processor or disk
  long memory = 1024;   // MB of address space, for each process
  long processes = 0;   // number of processes that the program may start; 0: only threads
  long threads = 64;    // number of threads, including the main one; enforced only if `processes` is 0
  long output = 4096;   // kB of standard output and error
  long answers = 4096;  // kB on the answers' pipe, descriptor 3
  long file = 16;       // MB, size of each file that the program writes
};

/// A program to run in a sandbox. If the grader runs as root, the program runs as a separate user and on copies of
/// `readable`, so that our folders can be private. Protected folders must be private, because a sandbox without
/// namespaces hides only private folders (see sees()). The program starts in `writable`, or in an empty private folder.
/// Its environment contains only PATH, LANG, HOME and TMPDIR. In sandbox bwrap, a program that may not start processes
/// has no /proc.
struct Job {
  std::vector<std::string> command;                  // absolute paths
  std::vector<std::filesystem::path> readable = {};  // folders that the program can read in addition to the system's
  std::filesystem::path writable = {};               // a folder that the program may write to; afterwards it contains
                                                     // only plain files and folders of ours. If empty, the program has
                                                     // a limited /tmp of its own in sandbox bwrap, and cannot create
                                                     // files in sandbox uid
  std::string input = {};                            // its standard input
  Limits limits = {};
  std::vector<int> passed = {};  // descriptors that the program gets as 4, 5, ...
};

/// Outcome. The first that applies: we stopped the program (wall, idle, output, answers); it exceeded its CPU time
/// (cpu); it ran out of memory, which it reported before it failed (last line `memory` on descriptor 3, or "bad_alloc"
/// or "out of memory" in captured_output), or the kernel killed it near its memory limit; a signal; an exit code.
struct End {
  enum class How { exited, signal, cpu, wall, idle, memory, output, answers } how = How::exited;
  int code = 0;                 // exit status, or the signal
  std::string answers;          // data from descriptor 3
  std::string captured_output;  // beginning of standard output and error
  double cpu = 0;               // s, sum over all of its processes
};

class Sandbox {
 public:
  virtual ~Sandbox() = default;
  virtual std::string_view name() const = 0;
  virtual std::string_view says() const = 0;  // describes the protection in one sentence
  /// Runs the job until it ends or reaches a limit. Afterwards none of its processes and no files outside
  /// `writable` exist. Thread-safe. Throws std::runtime_error if the job cannot be started, but never for what the
  /// program does.
  virtual End run(const Job& job) const = 0;
};

/// The first sandbox that passes a test; `named` selects one by name. If none is available and `unsafe` is false,
/// throws std::runtime_error with each sandbox's reason and the meaning of --no-sandbox.
std::unique_ptr<Sandbox> choose_sandbox(const std::string& named, bool unsafe);

/// The sandbox of this name (which may be bare), without a test, to continue an earlier choice. Throws
/// std::runtime_error if there is no such sandbox.
std::unique_ptr<Sandbox> sandbox_named(const std::string& name);

/// Tests by trial whether a program in this sandbox can read the folder or file. The grader does so for tests,
/// solution, secret and other people's submissions before it runs anything. Throws std::runtime_error if the trial
/// fails.
bool sees(const Sandbox& sandbox, const std::filesystem::path& secret);

// Available sandboxes, for the table in sandbox.cpp.

/// Bubblewrap: separate namespaces.
std::unique_ptr<Sandbox> bwrap_sandbox();
/// A separate user per run, for root in a container that forbids namespaces.
std::unique_ptr<Sandbox> uid_sandbox();
/// Limits and the system-call filter only.
std::unique_ptr<Sandbox> bare_sandbox();

}  // namespace coursework
