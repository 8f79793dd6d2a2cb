#include "experiments/sweep/sweep.h"

#include <fmt/format.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstring>
#include <map>
#include <system_error>

#include "experiments/experiment.h"
#include "experiments/sweep/work_queue.h"
#include "mysim/base/errors.h"

namespace crosscheck {
namespace {

/// Makes waitpid() work even if this program's parent ignores SIGCHLD, in which case the system would reap the children
/// itself.
class DefaultSigchld {
 public:
  DefaultSigchld() {
    struct sigaction usual {};
    usual.sa_handler = SIG_DFL;
    sigaction(SIGCHLD, &usual, &before_);
  }
  ~DefaultSigchld() { sigaction(SIGCHLD, &before_, nullptr); }
  DefaultSigchld(const DefaultSigchld&) = delete;
  DefaultSigchld& operator=(const DefaultSigchld&) = delete;

 private:
  struct sigaction before_ {};
};

class Batch {
 public:
  Batch(std::vector<const Point*> points, int jobs, const Store& store, Progress& progress,
        const LockPatience& patience)
      : points_(std::move(points)),
        store_(store),
        progress_(progress),
        patience_(patience),
        pids_(static_cast<size_t>(jobs), -1) {}

  std::vector<FailedPoint> run() {
    const DefaultSigchld kept;
    for (const Point* point : points_) store_.forget_failure(point->hash());
    for (size_t w = 0; w < pids_.size(); ++w) start(w);
    int running = static_cast<int>(pids_.size());
    while (running > 0) {
      announce();
      int status = 0;
      const pid_t pid = waitpid(-1, &status, WNOHANG);
      if (pid < 0 && errno == ECHILD) break;  // other code waited for the processes; missing points are reported below
      if (pid <= 0) {
        usleep(20000);
        continue;
      }
      const auto worker = std::find(pids_.begin(), pids_.end(), pid);
      if (worker == pids_.end()) continue;
      const size_t w = static_cast<size_t>(worker - pids_.begin());
      *worker = -1;
      --running;
      if (WIFEXITED(status) && WEXITSTATUS(status) == 0) continue;
      const int at = queue_->current[w].exchange(-1);
      if (at >= 0 && WIFSIGNALED(status))
        died_[points_[static_cast<size_t>(at)]] =
            fmt::format("it was killed by signal {} ({})", WTERMSIG(status), strsignal(WTERMSIG(status)));
      if (queue_->next < static_cast<int>(points_.size())) {
        start(w);
        ++running;
      }
    }
    announce();
    std::vector<FailedPoint> failed;
    for (const Point* point : points_) {
      if (store_.has(point->hash())) continue;
      const auto why = store_.failure_of(point->hash());
      failed.push_back({point->name, why ? *why : died_.contains(point) ? died_[point] : "it ended early"});
    }
    return failed;
  }

 private:
  void announce() {
    const int begun = std::min(queue_->next.load(), static_cast<int>(points_.size()));
    while (announced_ < begun) progress_.begin(points_[static_cast<size_t>(announced_++)]->name);
  }

  void start(size_t worker) {
    std::fflush(nullptr);  // otherwise the child would print buffered text again
    const pid_t parent = getpid(), pid = progress_.fork();
    if (pid < 0) throw std::system_error(errno, std::generic_category(), "fork");
    if (pid == 0) {
      // the worker ends if the sweep is killed, because a resumed sweep would compute the same points concurrently
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      if (getppid() != parent) _exit(1);
      work(worker);
      _exit(0);
    }
    pids_[worker] = pid;
  }

  void work(size_t worker) {
    for (int i; (i = queue_->next++) < static_cast<int>(points_.size());) {
      const Point& point = *points_[static_cast<size_t>(i)];
      queue_->current[worker] = i;
      if (point.timed) pin_to_one_core();
      const MachineLock lock(point.timed ? MachineLock::Mode::exclusive : MachineLock::Mode::shared, patience_);
      try {
        TableSet tables;
        const auto rows = point.after ? store_.find(point.after->hash()) : std::nullopt;
        rows ? point.compute_from(*rows, tables) : point.compute(tables);
        if (point.timed && !lock.held())
          tables.notes.push_back(fmt::format("{} was timed during other work: its times may be disturbed", point.name));
        store_.keep(point.hash(), tables);
      } catch (const std::exception& error) {
        store_.keep_failure(point.hash(), error.what());
      }
      queue_->current[worker] = -1;
    }
  }

  std::vector<const Point*> points_;
  const Store& store_;
  Progress& progress_;
  LockPatience patience_;
  std::vector<pid_t> pids_;
  SharedWorkQueue queue_;
  std::map<const Point*, std::string> died_;  // description of the signal
  int announced_ = 0;
};

}  // namespace

Shard shard_from(const std::string& text) {
  Shard shard;
  const size_t slash = text.find('/');
  auto number = [](std::string_view part, int& value) {
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
    return error == std::errc() && end == part.data() + part.size();
  };
  if (slash == std::string::npos || !number(std::string_view(text).substr(0, slash), shard.index) ||
      !number(std::string_view(text).substr(slash + 1), shard.count) || shard.index < 1 || shard.index > shard.count)
    throw InputError(fmt::format("--shard {}: expected I/N with 1 <= I <= N", text));
  return shard;
}

std::vector<FailedPoint> run_points(std::span<const Point> points, const SweepOptions& options, const Store& store,
                                    Progress& progress) {
  const int jobs = std::clamp(options.jobs > 0 ? options.jobs : cores_allowed(), 1, WorkQueue::most_workers);
  std::vector<FailedPoint> failed;
  for (const bool timed : {false, true}) {
    std::vector<const Point*> todo;
    for (size_t i = 0; i < points.size(); ++i)
      if (points[i].timed == timed && options.shard.holds(i)) {
        if (store.has(points[i].hash()))
          progress.expect(-1);
        else
          todo.push_back(&points[i]);
      }
    if (todo.empty()) continue;
    std::ranges::stable_partition(todo, &Point::is_long);
    const int workers = timed ? 1 : std::min(jobs, static_cast<int>(todo.size()));
    for (FailedPoint& f : Batch(std::move(todo), workers, store, progress, options.patience).run())
      failed.push_back(std::move(f));
  }
  return failed;
}

TableSet joined(const PointList& list, std::span<const Store> stores, std::vector<std::string>& missing) {
  TableSet all;
  for (const PointList::Entry& point : list.points) {
    std::optional<TableSet> tables;
    std::string fault;
    for (size_t i = 0; i < stores.size() && !tables; ++i) tables = stores[i].find(point.hash, &fault);
    if (!tables)
      missing.push_back(point.name + fault);
    else
      try {
        all.append(*tables);
      } catch (const std::logic_error& error) {
        throw InputError(fmt::format("{}, {}.json: {}", point.name, point.hash, error.what()));
      }
  }
  for (const std::string& name : list.experiments)
    if (const Experiment& experiment = find_experiment(name); experiment.conclude) experiment.conclude(all);
  return all;
}

TableSet computed(std::span<const Point> points) {
  TableSet all;
  for (const Point& point : points) {
    TableSet tables;
    point.compute(tables);
    all.append(tables);
  }
  return all;
}

}  // namespace crosscheck
