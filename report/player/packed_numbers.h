// Rows of 16-bit integers as bytes of gzip; report/CONTRACT.md describes the format, unpack.ts reads it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace crosscheck {

/// Packs rows with this many columns. Each number is replaced by its difference from the one above it (zeros above the
/// first row). Differences modulo 2^16 are mapped from 0, -1, 1, -2, ... to 0, 1, 2, 3, ... All low bytes precede all
/// high bytes, and gzip compresses them. Throws std::runtime_error if zlib fails.
std::string pack(std::vector<std::uint16_t> numbers, size_t columns);

/// Restores the numbers. Throws std::runtime_error unless the bytes are one gzip member of exactly `count` numbers.
std::vector<std::uint16_t> unpack(std::string_view bytes, size_t count, size_t columns);

/// Compresses to gzip as browsers read it. Throws std::runtime_error if zlib fails.
std::string gzipped(std::string_view bytes);

}  // namespace crosscheck
