// Memory that the processes of a sweep share.
#pragma once

#include <sys/mman.h>

#include <atomic>
#include <cerrno>
#include <new>
#include <system_error>

namespace crosscheck {

/// What parent and workers share. A worker that dies leaves the number of its point behind.
struct Board {
  static constexpr int most_workers = 256;
  std::atomic<int> next{0};
  std::atomic<int> current[most_workers];  // point that the worker is at, or -1
};

class SharedBoard {
 public:
  SharedBoard() {
    memory_ = mmap(nullptr, sizeof(Board), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory_ == MAP_FAILED) throw std::system_error(errno, std::generic_category(), "mmap");
    board_ = new (memory_) Board;
    for (auto& c : board_->current) c = -1;
  }
  ~SharedBoard() { munmap(memory_, sizeof(Board)); }
  SharedBoard(const SharedBoard&) = delete;
  SharedBoard& operator=(const SharedBoard&) = delete;
  Board* operator->() { return board_; }

 private:
  void* memory_;
  Board* board_;
};

}  // namespace crosscheck
