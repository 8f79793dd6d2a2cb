// Whole numbers of 16 bits, packed small for the page; unpack.js opens them.
//
// Numbers that belong together (the same coordinate of the next particle, the same mode one frame later) lie `lag`
// apart. Differences over that lag are taken `order` times. Signs go to the lowest bit (zigzag: 0, -1, 1, -2, ...
// become 0, 1, 2, 3, ...), so that small differences have a high byte of zero, all low bytes are put before all high
// ones, and gzip does the rest. Sums and differences wrap at 2^16: nothing is lost.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace crosscheck {

struct PackedNumbers {
  size_t count;      // numbers
  size_t lag;        // distance of numbers that belong together
  int order;         // how often differences are taken, from number k * lag on the k-th time
  std::string data;  // base64 of gzip
};

/// The same numbers give the same text. Throws std::runtime_error when zlib refuses.
PackedNumbers pack(std::vector<std::uint16_t> numbers, size_t lag, int order);
/// With the lag (1 or 3, the coordinates of a place) and the order that make it smallest.
PackedNumbers pack_small(const std::vector<std::uint16_t>& numbers);

/// The numbers again. Throws std::runtime_error where they are not those of a PackedNumbers.
std::vector<std::uint16_t> unpack(const PackedNumbers& packed);

/// gzip, as browsers read it. Throws std::runtime_error when zlib refuses.
std::string gzipped(std::string bytes);

}  // namespace crosscheck
