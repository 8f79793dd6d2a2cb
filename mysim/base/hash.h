// FNV-1a (64 bit; G. Fowler, L. C. Noll, K.-P. Vo), not cryptographically secure.
#pragma once

#include <cstdint>
#include <string_view>

namespace crosscheck {

class Fnv1a {
 public:
  void add(unsigned char byte) { state_ = (state_ ^ byte) * 0x100000001b3ull; }
  std::uint64_t value() const { return state_; }

  static std::uint64_t of(std::string_view bytes) {
    Fnv1a sum;
    for (const char c : bytes) sum.add(static_cast<unsigned char>(c));
    return sum.value();
  }

 private:
  std::uint64_t state_ = 0xcbf29ce484222325ull;
};

}  // namespace crosscheck
