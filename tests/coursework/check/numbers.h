// Sequential access to a list of numbers.
#pragma once

#include <vector>

#include "case.h"

namespace coursework {

/// Reads the numbers of a call in order; throws std::out_of_range after the last. Vectors can have any type with
/// members x, y, z.
class Reader {
 public:
  explicit Reader(const Numbers& in) : in_(in) {}
  double number() { return in_.at(at_++); }
  int integer() { return static_cast<int>(number()); }
  std::size_t count() { return static_cast<std::size_t>(number()); }
  template <class V>
  V vector() {
    const double x = number(), y = number(), z = number();
    return V{x, y, z};
  }
  template <class V>
  std::vector<V> vectors(std::size_t count) {
    std::vector<V> all;
    while (count-- > 0) all.push_back(vector<V>());
    return all;
  }
  Numbers numbers(std::size_t count) {
    Numbers all;
    while (count-- > 0) all.push_back(number());
    return all;
  }

 private:
  const Numbers& in_;
  std::size_t at_ = 0;
};

template <class V>
void put(Numbers& out, const V& v) {
  out.insert(out.end(), {v.x, v.y, v.z});
}
template <class V>
void put(Numbers& out, const std::vector<V>& all) {
  for (const V& v : all) put(out, v);
}

}  // namespace coursework
