#include "tests/coursework/grader/sandbox.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/mman.h>
#include <sys/utsname.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <optional>
#include <stdexcept>

#include "mysim/base/errors.h"
#include "mysim/base/text.h"
#include "tests/coursework/grader/assignment.h"
#include "tests/coursework/grader/seccomp.h"
#include "tests/coursework/grader/spawn.h"
#include "tests/coursework/grader/staging.h"

namespace coursework {
namespace {

class BareSandbox final : public Sandbox {
 public:
  std::string_view name() const override { return "bare"; }
  std::string_view says() const override {
    return "limits time, memory, processes and output only; the submission can read and change whatever you can.";
  }

  End run(const Job& job) const override {
    StagingFolder staging(job, 0);
    SpawnOptions start;
    start.command = job.command;
    start.environment = {"PATH=/usr/bin:/bin", "LANG=C", "HOME=" + staging.own().string(),
                         "TMPDIR=" + staging.own().string()};
    start.folder = job.writable.empty() ? staging.own() : job.writable;
    // Only the filter restricts which processes the command may start. The system's limit on processes is not set,
    // because it would count all processes of the user.
    start.filter = job.limits.processes > 0 ? std::string() : none_;
    start.input = job.input;
    start.limits = job.limits;
    start.passed = job.passed;
    start.processes = -1;
    End end = classify(spawn(start), job.limits, false);
    staging.give_back();
    return end;
  }

 private:
  std::string none_ = filter_program({.creates = true});
};

}  // namespace

std::unique_ptr<Sandbox> bare_sandbox() { return std::make_unique<BareSandbox>(); }

namespace {

constexpr const char* bwrap = "/usr/bin/bwrap";
constexpr const char* system_folders[] = {"/usr", "/bin", "/lib", "/lib64", "/etc/alternatives"};

/// A file in memory, whose descriptor is above those that the program gets.
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

/// True for Linux 5.14 and later, which apply the limit on processes per namespace. Earlier kernels count all processes
/// of the user.
bool counts_by_namespace() {
  utsname system{};
  int major = 0, minor = 0;
  return uname(&system) == 0 && std::sscanf(system.release, "%d.%d", &major, &minor) == 2 &&
         (major > 5 || (major == 5 && minor >= 14));
}

/// Limit on tasks of the program's user, including the program itself.
long tasks(const Limits& limits) { return limits.processes > 0 ? limits.processes + 1 : limits.threads; }

std::vector<std::string> arguments(const Job& job, const StagingFolder& staging) {
  std::vector<std::string> all{bwrap, "--unshare-all", "--die-with-parent", "--new-session", "--cap-drop",
                               "ALL", "--hostname",    "sandbox",           "--clearenv"};
  const auto add = [&all](std::initializer_list<std::string> more) { all.insert(all.end(), more); };
  for (const char* folder : system_folders) add({"--ro-bind-try", folder, folder});
  // hides the tests of an installed Crosscheck, which are in one of the system's folders
  if (const auto tests = folder_of_coursework(); tests.string().starts_with("/usr/"))
    add({"--tmpfs", tests.string(), "--remount-ro", tests.string()});
  // The first process inside is bwrap's own. It has the same user as the program, but no filter, so a program with
  // access to /proc could write to that process's memory. Compilers see /proc, students' programs do not.
  if (job.limits.processes > 0) add({"--proc", "/proc"});
  // Four times the limit on one file, which is enough for several files.
  add({"--dev", "/dev", "--size", std::to_string(4 * (job.limits.file << 20)), "--tmpfs", "/tmp"});
  for (const auto& folder : job.readable) add({"--ro-bind", staging.of(folder).string(), folder.string()});
  if (!job.writable.empty()) add({"--bind", staging.of(job.writable).string(), job.writable.string()});
  add({"--remount-ro", "/dev", "--remount-ro", "/"});
  add({"--setenv", "PATH", "/usr/bin:/bin", "--setenv", "LANG", "C", "--setenv", "HOME", "/tmp", "--setenv", "TMPDIR",
       "/tmp"});
  add({"--chdir", job.writable.empty() ? "/tmp" : job.writable.string()});
  const std::size_t first = 4 + job.passed.size();
  add({"--seccomp", std::to_string(first), "--json-status-fd", std::to_string(first + 1), "--"});
  // The limit is set inside the namespace, where only processes of the namespace count. -u is bash's option, -p dash's.
  if (job.limits.processes == 0 && geteuid() != 0 && counts_by_namespace())
    add({"/bin/sh", "-c", R"({ ulimit -u "$0" || ulimit -p "$0"; } 2>/dev/null; exec "$@")",
         std::to_string(job.limits.threads + 1)});
  all.insert(all.end(), job.command.begin(), job.command.end());
  return all;
}

class BwrapSandbox final : public Sandbox {
 public:
  std::string_view name() const override { return "bwrap"; }
  std::string_view says() const override {
    return "no network; of files only the system's, read-only, and a /tmp of its own; other processes are invisible.";
  }

  End run(const Job& job) const override {
    if (access(bwrap, X_OK) != 0) throw std::runtime_error("bubblewrap is not installed");
    // Under root's own uid the limit on processes would not apply, and any leak would expose everything.
    std::optional<SandboxUser> user;
    if (geteuid() == 0) user.emplace();
    StagingFolder staging(job, user ? user->id() : 0);
    const MemoryFile filter(job.limits.processes > 0 ? some_ : none_), status("");
    SpawnOptions start;
    start.command = arguments(job, staging);
    start.folder = "/";
    start.user = user ? user->id() : 0;
    start.lock = user ? user->lock() : -1;
    start.passed = job.passed;
    start.passed.insert(start.passed.end(), {filter.get(), status.get()});
    start.input = job.input;
    start.limits = job.limits;
    // tasks() includes the program; bwrap and its first process inside count, too. Without a separate user, all
    // processes of the calling user would count. In that case the limit on threads is set inside, and the number of
    // processes is unlimited until the wall-clock limit stops the run and ends the namespace.
    start.processes = user ? tasks(job.limits) + 2 : -1;
    ProcessResult ended = spawn(start);
    const bool stopped = ended.wall || ended.idle || ended.output || ended.full;
    if (!stopped && status.content().find("exit-code") == std::string::npos && WIFEXITED(ended.status))
      throw std::runtime_error(ended.captured_output.empty()
                                   ? "bwrap does not run"
                                   : ended.captured_output.substr(0, ended.captured_output.find('\n')));
    staging.give_back();
    return classify(std::move(ended), job.limits, true);
  }

 private:
  std::string none_ = filter_program({.creates = true}), some_ = filter_program({.starts = true, .creates = true});
};

}  // namespace

std::unique_ptr<Sandbox> bwrap_sandbox() { return std::make_unique<BwrapSandbox>(); }

namespace {

class UidSandbox final : public Sandbox {
 public:
  std::string_view name() const override { return "uid"; }
  std::string_view says() const override {
    return "each run has its own user, without access to the network and to folders of mode 0700. It sees the command "
           "lines of other processes, and can read files that are open to everyone on this machine.";
  }

  End run(const Job& job) const override {
    if (geteuid() != 0) throw std::runtime_error("it needs root, to become another user for each run");
    const SandboxUser user;
    StagingFolder staging(job, user.id());
    SpawnOptions start;
    start.command = staging.command();
    start.environment = {"PATH=/usr/bin:/bin", "LANG=C", "HOME=" + staging.own().string(),
                         "TMPDIR=" + staging.own().string()};
    start.folder = job.writable.empty() ? staging.own() : staging.of(job.writable);
    start.user = user.id();
    start.lock = user.lock();
    // Nothing limits the total size of the program's files, so a program without a writable folder must not create any.
    start.filter = filter_program({job.limits.processes > 0, !job.writable.empty()});
    start.input = job.input;
    start.limits = job.limits;
    start.passed = job.passed;
    start.processes = tasks(job.limits);
    End end = classify(spawn(start), job.limits, false);
    staging.give_back();
    return end;
  }
};

}  // namespace

std::unique_ptr<Sandbox> uid_sandbox() { return std::make_unique<UidSandbox>(); }

namespace {

struct Row {
  std::string_view name;
  std::unique_ptr<Sandbox> (*make)();
};

// Sandboxes in the order in which they are tried. `bare` is never chosen automatically.
constexpr Row sandboxes[] = {{"bwrap", bwrap_sandbox}, {"uid", uid_sandbox}};

constexpr std::string_view no_sandbox_means =
    "With --no-sandbox submissions run as you: they can read and change whatever you can, including the tests and the "
    "results, and use the network; only time, memory, processes and output are limited. Use it only for code that you "
    "trust, or in a virtual machine that you delete afterwards.";

/// Even a shell takes seconds to start on a machine under load.
constexpr Limits probe_limits{.wall = 60};

/// Runs a shell in the sandbox. Returns an empty string if the shell runs, sees no secret of ours and cannot start a
/// process; otherwise the reason.
std::string lacks(const Sandbox& sandbox) {
  const PrivateFolder secret(0700);
  try {
    Job job;
    job.command = {"/bin/sh", "-c",
                   R"(if [ -r "$0" ]; then echo sees >&3; else echo blind >&3; fi; (true) && echo forks >&3)",
                   secret.path().string()};
    job.limits = probe_limits;
    const End end = sandbox.run(job);
    if (end.answers == "blind\n") return {};
    if (end.answers.find("sees") == 0) return "a program in it still reads folders of mode 0700";
    if (end.answers.find("forks") != std::string::npos) return "a program in it still starts others";
    return end.captured_output.empty() ? "a shell does not run in it"
                                       : end.captured_output.substr(0, end.captured_output.find('\n'));
  } catch (const std::runtime_error& error) {
    return error.what();
  }
}

}  // namespace

std::unique_ptr<Sandbox> choose_sandbox(const std::string& named, bool unsafe) {
  if (named == "bare" || (named.empty() && unsafe)) {
    if (unsafe) return bare_sandbox();
    throw std::runtime_error(fmt::format("lane bare needs --no-sandbox as well. {}", no_sandbox_means));
  }
  std::string reasons, names;
  bool known = false;
  for (const Row& row : sandboxes) {
    names += fmt::format("{}, ", row.name);
    if (!named.empty() && named != row.name) continue;
    known = true;
    auto sandbox = row.make();
    const std::string why = lacks(*sandbox);
    if (why.empty()) return sandbox;
    reasons += fmt::format("  {}: {}\n", row.name, why);
  }
  if (!known)
    throw crosscheck::InputError(fmt::format("--lane {}: there is no such lane; expected one of: {}bare{}", named,
                                             names, crosscheck::did_you_mean(named, {"bwrap", "uid", "bare"})));
  throw std::runtime_error(
      fmt::format("Nothing here keeps a submission away from your files, so it is not run:\n{}"
                  "Install bubblewrap where user namespaces are allowed, or run the grader as root.\n{}",
                  reasons, no_sandbox_means));
}

std::unique_ptr<Sandbox> sandbox_named(const std::string& name) {
  if (name == "bare") return bare_sandbox();
  for (const Row& row : sandboxes)
    if (row.name == name) return row.make();
  throw crosscheck::InputError(fmt::format("--lane {}: there is no such lane; expected bwrap, uid or bare{}", name,
                                           crosscheck::did_you_mean(name, {"bwrap", "uid", "bare"})));
}

bool sees(const Sandbox& sandbox, const std::filesystem::path& secret) {
  Job job;
  job.command = {"/bin/sh", "-c", R"(if [ -r "$0" ]; then echo sees; else echo blind; fi >&3)",
                 std::filesystem::absolute(secret).string()};
  job.limits = probe_limits;
  const std::string answer = sandbox.run(job).answers;
  if (answer != "sees\n" && answer != "blind\n")
    throw std::runtime_error(
        fmt::format("sandbox {}: no answer to whether a program in it can read {}", sandbox.name(), secret.string()));
  return answer == "sees\n";
}

}  // namespace coursework
