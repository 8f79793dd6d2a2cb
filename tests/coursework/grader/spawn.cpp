#include "tests/coursework/grader/spawn.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include "tests/coursework/grader/supervise.h"

namespace coursework {
namespace {

constexpr std::size_t kept_chatter = 64 << 10;
constexpr int above = 32;  // ours lie above the numbers that the program's get

class Descriptor {
 public:
  explicit Descriptor(int fd = -1) : fd_(fd) {}
  ~Descriptor() { reset(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(fd_, other.fd_);
    return *this;
  }
  void reset() {
    if (fd_ >= 0) close(fd_);
    fd_ = -1;
  }
  int get() const { return fd_; }

 private:
  int fd_;
};

struct Pipe {
  Descriptor from, to;
  Pipe() {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error(fmt::format("no pipe: {}", std::strerror(errno)));
    from = Descriptor(fcntl(ends[0], F_DUPFD_CLOEXEC, above));
    to = Descriptor(fcntl(ends[1], F_DUPFD_CLOEXEC, above));
    close(ends[0]);
    close(ends[1]);
    if (from.get() < 0 || to.get() < 0) throw std::runtime_error("no pipe: too many open files");
  }
};

/// Signals that would disturb this thread while it feeds and waits; as before at the end.
class Quiet {
 public:
  Quiet() {
    for (const int number : {SIGPIPE, SIGTERM, SIGCHLD}) sigaddset(&ours_, number);
    pthread_sigmask(SIG_BLOCK, &ours_, &before_);
  }
  ~Quiet() {
    sigset_t pipe{};
    sigaddset(&pipe, SIGPIPE);
    const timespec at_once{};
    if (!sigismember(&before_, SIGPIPE)) sigtimedwait(&pipe, nullptr, &at_once);  // one of our own writes
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }

 private:
  sigset_t ours_{}, before_{};
};

std::vector<char*> pointers(const std::vector<std::string>& texts) {
  std::vector<char*> all;
  for (const std::string& text : texts) all.push_back(const_cast<char*>(text.c_str()));
  all.push_back(nullptr);
  return all;
}

/// What is there now, up to `most` in all kept. Returns false at the end of file.
bool take(int fd, std::string& kept, std::size_t most, std::size_t& seen) {
  char block[65536];
  ssize_t got;
  while ((got = read(fd, block, sizeof block)) > 0) {
    seen += static_cast<std::size_t>(got);
    kept.append(block, std::min(static_cast<std::size_t>(got), most - std::min(most, kept.size())));
    if (seen > most + sizeof block) break;
  }
  return got != 0;
}

/// Feeds, listens and watches the clock until the supervisor reports.
Report attend(const Start& start, pid_t supervisor, Pipe& in, Pipe& answers, Pipe& chatter, Pipe& reports,
              Ended& ended) {
  for (Pipe* pipe : {&answers, &chatter, &reports}) {
    pipe->to.reset();
    fcntl(pipe->from.get(), F_SETFL, O_NONBLOCK);
  }
  in.from.reset();
  fcntl(in.to.get(), F_SETFL, O_NONBLOCK);
  using Clock = std::chrono::steady_clock;
  const auto deadline = Clock::now() + std::chrono::duration<double>(start.limits.wall);
  const auto most = static_cast<std::size_t>(start.limits.output) << 10;
  std::size_t fed = 0, answered = 0, chattered = 0;
  bool stopped = false;
  Report report;
  for (;;) {
    if (fed == start.input.size()) in.to.reset();
    pollfd watched[] = {{reports.from.get(), POLLIN, 0},
                        {answers.from.get(), POLLIN, 0},
                        {chatter.from.get(), POLLIN, 0},
                        {in.to.get(), POLLOUT, 0}};
    const double left = std::chrono::duration<double>(deadline - Clock::now()).count();
    poll(watched, std::size(watched), stopped ? -1 : std::max(0, static_cast<int>(std::ceil(left * 1e3))));
    if (watched[3].revents) {
      const ssize_t wrote = write(in.to.get(), start.input.data() + fed, start.input.size() - fed);
      fed = wrote > 0 ? fed + static_cast<std::size_t>(wrote) : errno == EAGAIN ? fed : start.input.size();
    }
    // The report comes when nothing of the program runs any more: what it wrote is in the pipes by then.
    const bool reported = watched[0].revents;
    if (!take(answers.from.get(), ended.answers, most, answered)) answers.from.reset();
    if (!take(chatter.from.get(), ended.chatter, kept_chatter, chattered)) chatter.from.reset();
    if (!ended.wall && (answered > most || chattered > most)) ended.output = true;
    if (reported) {
      if (read(reports.from.get(), &report, sizeof report) != sizeof report)
        report.failed = "watch over the program (its supervisor was killed)";
      return report;
    }
    if (!stopped && !ended.output && Clock::now() >= deadline) ended.wall = true;
    if (!stopped && (ended.output || ended.wall)) {
      kill(supervisor, SIGTERM);
      stopped = true;
    }
  }
}

}  // namespace

Ended spawn(const Start& start) {
  const auto command = pointers(start.command), environment = pointers(start.environment);
  const sock_fprog filter{static_cast<unsigned short>(start.filter.size() / sizeof(sock_filter)),
                          reinterpret_cast<sock_filter*>(const_cast<char*>(start.filter.data()))};
  Pipe in, answers, chatter, reports;
  std::vector<int> descriptors{in.from.get(), chatter.to.get(), chatter.to.get(), answers.to.get()};
  descriptors.insert(descriptors.end(), start.passed.begin(), start.passed.end());
  const std::string folder = start.folder.string();
  const Plan plan{command.data(),
                  environment.data(),
                  folder.c_str(),
                  start.user,
                  start.filter.empty() ? nullptr : &filter,
                  descriptors.data(),
                  static_cast<int>(descriptors.size()),
                  reports.to.get(),
                  static_cast<rlim_t>(std::ceil(start.limits.cpu)),
                  static_cast<rlim_t>(start.limits.memory) << 20,
                  static_cast<rlim_t>(start.limits.file) << 20,
                  static_cast<rlim_t>(start.processes)};
  const Quiet quiet;
  const pid_t supervisor = fork();
  if (supervisor < 0) throw std::runtime_error(fmt::format("cannot start a process: {}", std::strerror(errno)));
  if (supervisor == 0) supervise(plan);
  Ended ended;
  const Report report = attend(start, supervisor, in, answers, chatter, reports, ended);
  waitpid(supervisor, nullptr, 0);
  if (report.failed)
    throw std::runtime_error(fmt::format("{}: cannot {}: {}", start.command[0], report.failed,
                                         report.error ? std::strerror(report.error) : "no report"));
  ended.status = report.status;
  ended.used = report.used;
  return ended;
}

}  // namespace coursework
