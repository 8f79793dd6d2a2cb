// A thread pool for pieces of work, one of which comes many thousand times a second.
#pragma once

#include <functional>
#include <memory>

namespace crosscheck::simd {

/// An idle thread spins for some microseconds, then yields to others, and falls
/// asleep when a millisecond has passed: waking up takes longer than a step of a small cloth.
class ThreadPool {
 public:
  /// So many threads in all; the calling one is the first.
  explicit ThreadPool(int threads);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  int size() const;
  /// work(0) ... work(size() - 1), which must not throw, each on a thread of its own; returns when all are done.
  void all(const std::function<void(int)>& work);
  /// CPU time of the other threads' work, s, without their waits.
  double seconds() const;

 private:
  struct Workers;
  std::unique_ptr<Workers> workers_;
};

}  // namespace crosscheck::simd
