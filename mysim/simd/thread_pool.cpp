// Threads that spin, then yield, then sleep until the next piece of work.
#include "mysim/simd/thread_pool.h"

#include <cassert>

#include "mysim/base/this_process.h"

namespace crosscheck::simd {
namespace {

/// Returns when `number` has become another one: what it is then.
long wait_for_change(const std::atomic<long>& number, long known) {
  constexpr int spins = 2000, yields = 2000;  // some tens of microseconds; about a millisecond
  for (int i = 0; i < spins + yields; ++i) {
    if (const long now = number.load(std::memory_order_acquire); now != known) return now;
    if (i < spins)
      __builtin_ia32_pause();
    else
      std::this_thread::yield();
  }
  number.wait(known, std::memory_order_acquire);
  return number.load(std::memory_order_acquire);
}

}  // namespace

ThreadPool::ThreadPool(int threads) : workers_(threads - 1) {
  assert(threads >= 1);
  for (int i = 1; i < threads; ++i) workers_[i - 1].thread = std::thread([this, i] { worker_loop(i); });
}

ThreadPool::~ThreadPool() {
  if (workers_.empty()) return;
  work_ = nullptr;
  begun_.fetch_add(1, std::memory_order_release);
  begun_.notify_all();
  for (Worker& worker : workers_) worker.thread.join();
}

void ThreadPool::worker_loop(int which) {
  for (long known = 0;;) {
    known = wait_for_change(begun_, known);
    if (!work_) return;
    CpuClock clock;
    clock.start();
    (*work_)(which);
    clock.stop();
    workers_[which - 1].seconds += clock.seconds();
    done_.fetch_add(1, std::memory_order_release);
    done_.notify_all();
  }
}

void ThreadPool::all(const std::function<void(int)>& work) {
  if (!workers_.empty()) {
    work_ = &work;
    begun_.fetch_add(1, std::memory_order_release);
    begun_.notify_all();
  }
  work(0);
  const long due = begun_.load(std::memory_order_relaxed) * static_cast<long>(workers_.size());
  for (long done = done_.load(std::memory_order_acquire); done != due; done = wait_for_change(done_, done)) {
  }
}

double ThreadPool::seconds() const {
  double sum = 0;
  for (const Worker& worker : workers_) sum += worker.seconds;
  return sum;
}

}  // namespace crosscheck::simd
