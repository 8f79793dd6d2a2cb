// Seeded numbers that are the same on every machine.
#pragma once

#include <cmath>
#include <cstdint>

namespace coursework {

/// The generator SplitMix64 (Steele, Lea, Flood 2014): it has a state of 64 bits and is equidistributed.
class Random {
 public:
  /// If `round` is true, uniform() returns nonzero numbers of few digits, for cases that can be computed on paper.
  explicit Random(std::uint64_t seed, bool round = false) : state_(seed), round_(round) {}
  bool rounds() const { return round_; }
  std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  /// A uniform number in [low, high).
  double uniform(double low, double high) {
    const double value = low + (high - low) * static_cast<double>(next() >> 11) * 0x1p-53;
    return round_ ? rounded(value, low, high) : value;
  }
  /// A uniform integer from `low` to `high`, inclusive.
  int integer(int low, int high) { return low + static_cast<int>(next() % static_cast<std::uint64_t>(high - low + 1)); }

 private:
  /// Nearest value on a decimal scale that has at least three steps between `low` and `high`.
  static double rounded(double value, double low, double high) {
    double parts = 1;  // steps per unit
    while ((high - low) * parts < 3 && parts < 1e9) parts *= 10;
    double near = std::round(value * parts) / parts;
    if (near < low || near == 0) near = (std::floor(low * parts) + 1) / parts;
    if (near == 0) near = 1 / parts;
    return near > high ? near - 1 / parts : near;
  }

  std::uint64_t state_;
  bool round_;
};

}  // namespace coursework
