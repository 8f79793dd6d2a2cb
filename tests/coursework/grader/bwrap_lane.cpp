#include <fcntl.h>
#include <fmt/core.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <optional>
#include <stdexcept>

#include "tests/coursework/grader/lanes.h"
#include "tests/coursework/grader/own_folder.h"
#include "tests/coursework/grader/seccomp.h"
#include "tests/coursework/grader/spawn.h"
#include "tests/coursework/grader/stage.h"

namespace coursework {
namespace {

constexpr const char* bwrap = "/usr/bin/bwrap";
constexpr const char* system_folders[] = {"/usr", "/bin", "/lib", "/lib64", "/etc/alternatives"};

/// A file in memory, under a number above those that the program gets.
class MemoryFile {
 public:
  explicit MemoryFile(const std::string& content) {
    const int low = memfd_create("crosscheck", MFD_CLOEXEC);
    fd_ = fcntl(low, F_DUPFD_CLOEXEC, 32);
    close(low);
    if (fd_ < 0 || pwrite(fd_, content.data(), content.size(), 0) != static_cast<ssize_t>(content.size()))
      throw std::runtime_error(fmt::format("no memory file: {}", std::strerror(errno)));
  }
  ~MemoryFile() { close(fd_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  int get() const { return fd_; }
  std::string content() const {
    std::string text(4096, '\0');
    const ssize_t got = pread(fd_, text.data(), text.size(), 0);
    text.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
    return text;
  }

 private:
  int fd_;
};

std::vector<std::string> arguments(const Job& job, const Stage& stage) {
  std::vector<std::string> all{bwrap, "--unshare-all", "--die-with-parent", "--new-session", "--cap-drop",
                               "ALL", "--hostname",    "sandbox",           "--clearenv"};
  const auto add = [&all](std::initializer_list<std::string> more) { all.insert(all.end(), more); };
  for (const char* folder : system_folders) add({"--ro-bind-try", folder, folder});
  // bwrap's own first process runs inside under the same user and without the filter: who has /proc could write to its
  // memory. Compilers are shown it, students' programs are not.
  if (job.limits.processes > 0) add({"--proc", "/proc"});
  // Four times what one file may have: several files, and yet an end.
  add({"--dev", "/dev", "--size", std::to_string(4 * (job.limits.file << 20)), "--tmpfs", "/tmp"});
  for (const auto& folder : job.readable) add({"--ro-bind", stage.of(folder).string(), folder.string()});
  if (!job.writable.empty()) add({"--bind", stage.of(job.writable).string(), job.writable.string()});
  add({"--remount-ro", "/dev", "--remount-ro", "/"});
  add({"--setenv", "PATH", "/usr/bin:/bin", "--setenv", "LANG", "C", "--setenv", "HOME", "/tmp", "--setenv", "TMPDIR",
       "/tmp"});
  add({"--chdir", job.writable.empty() ? "/tmp" : job.writable.string()});
  add({"--seccomp", "4", "--json-status-fd", "5", "--"});
  all.insert(all.end(), job.command.begin(), job.command.end());
  return all;
}

class BwrapLane final : public Lane {
 public:
  std::string_view name() const override { return "bwrap"; }
  std::string_view says() const override {
    return "no network, no files but the system's own, read only, its own /tmp, and no other process in sight.";
  }

  End run(const Job& job) const override {
    if (access(bwrap, X_OK) != 0) throw std::runtime_error("bubblewrap is not installed");
    // Root's own number would lift the limit on processes, and make of any leak a leak of everything.
    std::optional<BorrowedUser> user;
    if (geteuid() == 0) user.emplace();
    Stage stage(job, user ? user->id() : 0);
    const MemoryFile filter(job.limits.processes > 0 ? some_ : none_), status("");
    Start start;
    start.command = arguments(job, stage);
    start.folder = "/";
    start.user = user ? user->id() : 0;
    start.passed = {filter.get(), status.get()};
    start.input = job.input;
    start.limits = job.limits;
    // bwrap itself, its first process inside, and the program. Without a user of its own all that its user, you, runs
    // would count as well: then the clock and the end of the namespace are the limit.
    start.processes = user ? job.limits.processes + 3 : -1;
    Ended ended = spawn(start);
    const bool stopped = ended.wall || ended.output;
    if (!stopped && status.content().find("exit-code") == std::string::npos && WIFEXITED(ended.status))
      throw std::runtime_error(ended.chatter.empty() ? "bwrap does not run"
                                                     : ended.chatter.substr(0, ended.chatter.find('\n')));
    stage.give_back();
    return classify(std::move(ended), job.limits, true);
  }

 private:
  std::string none_ = filter_program({.creates = true}), some_ = filter_program({.starts = true, .creates = true});
};

}  // namespace

std::unique_ptr<Lane> bwrap_lane() { return std::make_unique<BwrapLane>(); }

}  // namespace coursework
