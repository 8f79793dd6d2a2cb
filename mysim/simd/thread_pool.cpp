#include "mysim/simd/thread_pool.h"

#include <atomic>
#include <cassert>
#include <thread>
#include <vector>

#include "mysim/base/this_process.h"

namespace crosscheck::simd {
namespace {

void pause() {
#ifdef __x86_64__
  __builtin_ia32_pause();
#else
  asm volatile("yield");
#endif
}

/// Waits until `number` differs from `known`; returns it.
long wait_for_change(const std::atomic<long>& number, long known) {
  constexpr int spins = 2000, yields = 2000;  // they last some 10 us and about a millisecond
  for (int i = 0; i < spins + yields; ++i) {
    if (const long now = number.load(std::memory_order_acquire); now != known) return now;
    if (i < spins)
      pause();
    else
      std::this_thread::yield();
  }
  number.wait(known, std::memory_order_acquire);
  return number.load(std::memory_order_acquire);
}

}  // namespace

struct ThreadPool::Workers {
  struct Worker {
    std::thread thread;
    double seconds = 0;
  };
  void loop(int which);

  std::vector<Worker> list;
  const std::function<void(int)>* work = nullptr;  // null: terminate
  std::atomic<long> begun = 0, done = 0;           // pieces begun, and pieces completed by other threads
};

ThreadPool::ThreadPool(int threads) : workers_(std::make_unique<Workers>()) {
  assert(threads >= 1);
  workers_->list = std::vector<Workers::Worker>(threads - 1);
  for (int i = 1; i < threads; ++i)
    workers_->list[i - 1].thread = std::thread([workers = workers_.get(), i] { workers->loop(i); });
}

ThreadPool::~ThreadPool() {
  if (workers_->list.empty()) return;
  workers_->work = nullptr;
  workers_->begun.fetch_add(1, std::memory_order_release);
  workers_->begun.notify_all();
  for (Workers::Worker& worker : workers_->list) worker.thread.join();
}

int ThreadPool::size() const { return static_cast<int>(workers_->list.size()) + 1; }

void ThreadPool::Workers::loop(int which) {
  for (long known = 0;;) {
    known = wait_for_change(begun, known);
    if (!work) return;
    CpuClock clock;
    clock.start();
    (*work)(which);
    clock.stop();
    list[which - 1].seconds += clock.seconds();
    done.fetch_add(1, std::memory_order_release);
    done.notify_all();
  }
}

void ThreadPool::all(const std::function<void(int)>& work) {
  Workers& others = *workers_;
  if (!others.list.empty()) {
    others.work = &work;
    others.begun.fetch_add(1, std::memory_order_release);
    others.begun.notify_all();
  }
  work(0);
  const long due = others.begun.load(std::memory_order_relaxed) * static_cast<long>(others.list.size());
  for (long done = others.done.load(std::memory_order_acquire); done != due;
       done = wait_for_change(others.done, done)) {
  }
}

double ThreadPool::seconds() const {
  double sum = 0;
  for (const Workers::Worker& worker : workers_->list) sum += worker.seconds;
  return sum;
}

}  // namespace crosscheck::simd
