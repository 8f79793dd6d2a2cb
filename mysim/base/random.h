// Seeded random numbers, identical with every standard library: raw engine output without std distributions.
#pragma once

#include <random>

namespace crosscheck {

/// Next number in [0, 1).
inline double uniform(std::mt19937_64& engine) { return static_cast<double>(engine() >> 11) * 0x1.0p-53; }

}  // namespace crosscheck
