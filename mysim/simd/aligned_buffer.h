#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <new>

namespace crosscheck::simd {

/// An array aligned to a cache line, with a spare cache line on either side.
template <class T>
class AlignedBuffer {
 public:
  AlignedBuffer() = default;
  explicit AlignedBuffer(size_t count) : size_(count) {
    const size_t bytes = (count * sizeof(T) + line_bytes - 1) / line_bytes * line_bytes + 2 * line_bytes;
    memory_.reset(static_cast<T*>(std::aligned_alloc(line_bytes, bytes)));
    if (!memory_) throw std::bad_alloc();
    std::fill_n(memory_.get(), bytes / sizeof(T), T(0));
    data_ = memory_.get() + line_bytes / sizeof(T);
    assert(reinterpret_cast<std::uintptr_t>(data_) % line_bytes == 0);
  }
  T* data() { return data_; }
  const T* data() const { return data_; }
  size_t size() const { return size_; }

 private:
  static constexpr size_t line_bytes = 64;
  struct Free {
    void operator()(T* memory) const { std::free(memory); }
  };
  std::unique_ptr<T, Free> memory_;
  T* data_ = nullptr;
  size_t size_ = 0;
};

}  // namespace crosscheck::simd
