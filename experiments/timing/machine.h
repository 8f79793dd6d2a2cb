// This machine: its processor, the cores that this process may use, and the lock for exclusive measurements.
#pragma once

#include <atomic>
#include <filesystem>
#include <memory>
#include <string>

namespace crosscheck {

/// Number of cores in the affinity mask, which batch systems and `taskset` set.
int cores_allowed();
/// Pins the process to the last core that it may use, so that its caches stay warm. Ignores failures.
void pin_to_one_core();

// A lock of this machine, shared by all sweeps of this user. It is held either by many concurrent untimed points or by
// one timed point, so that shards on one machine do not disturb each other's timings.

/// Total time for which a command and its forked processes may wait for locks. A command creates one object and passes
/// it to everything that computes or times; copies share the remaining time.
class LockPatience {
 public:
  explicit LockPatience(double seconds = 60);
  /// True if the time was used up and something was then measured while other work was running.
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

constexpr auto timed_beside_other_work = "some times were measured during other work and may be disturbed";

class MachineLock {
 public:
  enum class Mode { shared, exclusive };
  /// Waits for the lock as long as the patience lasts, and reports once on standard error who holds the lock and since
  /// when. Then continues without the lock. The lock file is /tmp/crosscheck-UID.lock, regardless of TMPDIR, because
  /// batch systems give each job its own TMPDIR; jobs with a private /tmp do not see each other. CROSSCHECK_LOCK names
  /// another file, so that tests wait only for each other. Does not wait if there is no lock file.
  MachineLock(Mode mode, const LockPatience& patience);
  /// False if another process may disturb the times.
  bool held() const { return held_; }
  ~MachineLock();
  MachineLock(const MachineLock&) = delete;
  MachineLock& operator=(const MachineLock&) = delete;

 private:
  int handle_;
  bool held_ = true;
};

}  // namespace crosscheck
