// This machine: its processor, the cores that this process may use, and the lock for exclusive measurements.
#pragma once

#include <atomic>
#include <filesystem>
#include <memory>
#include <string>

namespace crosscheck {

// Processor cores: their number, and pinning to one of them.

/// Number of cores in the affinity mask, which batch systems and `taskset` set.
int cores_allowed();
/// Pins the calling process to the last core that it may use, so that its caches stay warm. Best effort.
void pin_to_one_core();

// A lock on this machine for either many concurrent untimed points or one timed point, across all sweeps of this user,
// so that shards on one machine do not disturb each other's timings.

/// Total time that all locks of one command may be waited for, including those in forked processes. A command creates
/// one object and passes it to everything that computes or times; copies share the remaining time.
class LockPatience {
 public:
  explicit LockPatience(double seconds = 60);
  /// True if the time is used up and something was measured next to other work since.
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

/// The note for measurements after the patience was exhausted.
constexpr auto timed_beside_other_work = "some times were measured beside other work and may be disturbed";

class MachineLock {
 public:
  enum class Mode { shared, exclusive };
  /// Waits for the lock as long as the patience lasts, and reports once on standard error who holds it and since when.
  /// Then continues without the lock. The lock file is /tmp/crosscheck-UID.lock, regardless of TMPDIR, because batch
  /// systems give each job a TMPDIR of its own; jobs with a private /tmp do not see each other. CROSSCHECK_LOCK names
  /// another file, which tests use to wait for themselves only. Without a lock file there is no wait.
  MachineLock(Mode mode, const LockPatience& patience);
  /// False if another process measures or computes at the same time, so that times may be disturbed.
  bool held() const { return held_; }
  ~MachineLock();
  MachineLock(const MachineLock&) = delete;
  MachineLock& operator=(const MachineLock&) = delete;

 private:
  int handle_;
  bool held_ = true;
};

}  // namespace crosscheck
