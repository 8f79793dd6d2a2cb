// A thread pool for work that arrives many thousand times per second.
#pragma once

#include <functional>
#include <memory>

namespace crosscheck::simd {

/// An idle thread spins for some microseconds, then yields, and sleeps only after a millisecond, because waking up
/// takes longer than a step of a small cloth.
class ThreadPool {
 public:
  /// `threads` includes the calling thread, which is the first.
  explicit ThreadPool(int threads);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  int size() const;
  /// Runs work(0) ... work(size() - 1), which must not throw, each on its thread; returns when all are done.
  void all(const std::function<void(int)>& work);
  /// CPU time (s) of the other threads, without waiting.
  double seconds() const;

 private:
  struct Workers;
  std::unique_ptr<Workers> workers_;
};

}  // namespace crosscheck::simd
