// Seeded random numbers that are the same with every standard library: raw engine output, no std distribution.
#pragma once

#include <random>

namespace crosscheck {

/// The next number from [0, 1).
inline double uniform(std::mt19937_64& engine) { return static_cast<double>(engine() >> 11) * 0x1.0p-53; }

}  // namespace crosscheck
