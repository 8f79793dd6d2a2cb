#pragma once

#include <sys/mman.h>

#include <atomic>
#include <cerrno>
#include <new>
#include <system_error>

namespace crosscheck {

/// Memory shared by the parent and its workers. If a worker dies, the index of its point remains.
struct WorkQueue {
  static constexpr int most_workers = 256;
  std::atomic<int> next{0};
  std::atomic<int> current[most_workers];  // current point of the worker, or -1
};

class SharedWorkQueue {
 public:
  SharedWorkQueue() {
    memory_ = mmap(nullptr, sizeof(WorkQueue), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory_ == MAP_FAILED) throw std::system_error(errno, std::generic_category(), "mmap");
    queue_ = new (memory_) WorkQueue;
    for (auto& c : queue_->current) c = -1;
  }
  ~SharedWorkQueue() { munmap(memory_, sizeof(WorkQueue)); }
  SharedWorkQueue(const SharedWorkQueue&) = delete;
  SharedWorkQueue& operator=(const SharedWorkQueue&) = delete;
  WorkQueue* operator->() { return queue_; }

 private:
  void* memory_;
  WorkQueue* queue_;
};

}  // namespace crosscheck
