// Rows of whole numbers of 16 bits as bytes of gzip; report/CONTRACT.md describes them, unpack.ts reads them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace crosscheck {

/// Rows of so many columns. Each number becomes its difference from the one above it (above the first row are zeros),
/// differences modulo 2^16 become 0, -1, 1, -2, ... = 0, 1, 2, 3, ..., all low bytes stand before all high bytes, and
/// gzip packs them. Throws std::runtime_error if zlib fails.
std::string pack(std::vector<std::uint16_t> numbers, size_t columns);

/// The numbers again. Throws std::runtime_error unless the bytes are one gzip member of exactly `count` numbers.
std::vector<std::uint16_t> unpack(std::string_view bytes, size_t count, size_t columns);

/// gzip as browsers read it. Throws std::runtime_error if zlib fails.
std::string gzipped(std::string_view bytes);

}  // namespace crosscheck
