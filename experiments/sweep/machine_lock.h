// Who may compute on this machine: many untimed points side by side, or one timed point alone, over all sweeps of this
// user, so that shards on one machine do not spoil each other's timings.
#pragma once

namespace crosscheck {

class MachineLock {
 public:
  enum class Hold { with_others, alone };
  /// Waits until it is had. The lock file is /tmp/crosscheck-UID.lock wherever TMPDIR points, since batch systems give
  /// each job a TMPDIR of its own; jobs that also have a /tmp of their own do not see each other. CROSSCHECK_LOCK
  /// names another file, as tests do, which wait for nobody but themselves. Where none can be made, nobody waits.
  explicit MachineLock(Hold hold);
  ~MachineLock();
  MachineLock(const MachineLock&) = delete;
  MachineLock& operator=(const MachineLock&) = delete;

 private:
  int handle_;
};

}  // namespace crosscheck
