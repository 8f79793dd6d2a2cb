// Packs rows of 16-bit integers with gzip, as in report/CONTRACT.md; unpack.ts reads them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace crosscheck {

/// Replaces each number by its difference from the number above it (zeros are above the first row), modulo 2^16, and
/// maps differences 0, -1, 1, -2, ... to 0, 1, 2, 3, ... Compresses all low bytes, then all high bytes. Throws
/// std::runtime_error if zlib fails.
std::string pack(std::vector<std::uint16_t> numbers, size_t columns);

/// Reverses pack(). Throws std::runtime_error unless the bytes are one gzip member with exactly `count` numbers.
std::vector<std::uint16_t> unpack(std::string_view bytes, size_t count, size_t columns);

/// Compresses to gzip. Throws std::runtime_error if zlib fails.
std::string gzipped(std::string_view bytes);

}  // namespace crosscheck
