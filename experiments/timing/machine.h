// This machine: its processor, the cores that this process may use, and the lock that lets one process measure alone.
#pragma once

#include <atomic>
#include <filesystem>
#include <memory>
#include <string>

namespace crosscheck {

// Processor cores: how many this process may use, and keeping to one of them.

/// As the affinity mask says, which batch systems and `taskset` set.
int cores_allowed();
/// Keeps the calling process to the last core that it may use, so that its caches stay warm. Best effort.
void pin_to_one_core();

// A lock on this machine for many untimed points side by side, or one timed point alone, over all sweeps of this
// user, so that shards on one machine do not spoil each other's timings.

/// The time that all locks of one command may be waited for together, also by processes forked from this one. A
/// command makes one object and passes it to everything that computes or times; copies share the remaining time.
class LockPatience {
 public:
  explicit LockPatience(double seconds = 60);
  /// True: the time was used up, and something was measured beside other work since.
  bool exhausted() const { return shared_->exhausted; }

 private:
  friend class MachineLock;
  struct Shared {
    double total;              // s
    std::atomic<double> left;  // s
    std::atomic<bool> announced = false, exhausted = false;
  };
  std::shared_ptr<Shared> shared_;
};

/// The mark of what was measured after the patience had been exhausted.
constexpr auto timed_beside_other_work = "some times were measured beside other work and may be disturbed";

class MachineLock {
 public:
  enum class Mode { shared, exclusive };
  /// Waits for the lock as long as the patience lasts, and reports once on standard error who holds it and since when;
  /// then goes on without the lock. The lock file is /tmp/crosscheck-UID.lock wherever TMPDIR points, since batch
  /// systems give each job a TMPDIR of its own; jobs that also have a /tmp of their own do not see each other.
  /// CROSSCHECK_LOCK names another file, as tests do, which then wait for themselves only. Without a lock file there is
  /// no wait.
  MachineLock(Mode mode, const LockPatience& patience);
  /// False: another process measures or computes at the same time, so that times may be disturbed.
  bool held() const { return held_; }
  ~MachineLock();
  MachineLock(const MachineLock&) = delete;
  MachineLock& operator=(const MachineLock&) = delete;

 private:
  int handle_;
  bool held_ = true;
};

}  // namespace crosscheck
