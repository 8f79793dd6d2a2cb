// Random draws of a probe. The grader repeats them (replay.cpp), so each draw is a separate statement, whose order no
// compiler may change.
#pragma once

#include <cstdint>
#include <utility>

#include "../../check/random.h"
#include "asker.h"

namespace probe {

class Draws {
 public:
  explicit Draws(std::uint64_t seed) : random_(seed) {}

  float number(double low, double high) { return static_cast<float>(random_.uniform(low, high)); }

  Plain direction() {
    for (;;) {
      Plain d;
      for (float& part : d.at) part = number(-1, 1);
      // no direction near an axis, so that a force that ignores one axis is detected
      const float size = length(d);
      if (size <= 1 && std::fabs(d[0]) > 0.2f && std::fabs(d[1]) > 0.2f && std::fabs(d[2]) > 0.2f)
        return plus({}, 1 / size, d);
    }
  }

  /// Up to `most` of the indices 0..count-1, in ascending order; all of them if count <= most.
  Indices sample(std::size_t count, std::size_t most = 200) {
    Indices chosen;
    for (std::size_t i = 0; i < count; ++i)
      if (below(count - i) < most - chosen.size()) chosen.push_back(i);
    return chosen;
  }

  void shuffle(Indices& all) {
    for (std::size_t i = all.size(); i > 1; --i) std::swap(all[i - 1], all[below(i)]);
  }

 private:
  std::size_t below(std::size_t count) {
    return static_cast<std::size_t>(random_.integer(0, static_cast<int>(count) - 1));
  }

  coursework::Random random_;
};

}  // namespace probe
