// Places and values as small whole numbers, packed small for the page; unpack.js opens them.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "mysim/types.h"

namespace crosscheck {

/// Places on a lattice of 2^14 points along each axis of the box around them.
struct QuantisedPositions {
  Vec3 low, unit;  // m: place = low + unit * number, axis by axis
  /// m, no place is further from its number's than this: half a unit along each axis, sqrt(ux^2 + uy^2 + uz^2) / 2, and
  /// a part in 10^12 of the box for the roundings of doubles. For a box of 2 m it is at most 0.11 mm.
  double bound;
  std::vector<std::uint16_t> numbers;  // frames x particles x 3
};
/// The places must be finite.
QuantisedPositions quantise(std::span<const Points> frames);

/// A lattice that the motions of a scene share: the box around the first one has 2^14 points along its longest side.
struct Lattice {
  Vec3 low;
  double unit;  // m, along each axis
  /// m, no place is further from its number's.
  double bound() const { return unit * std::sqrt(3.) / 2 + 1e-12 * low.norm(); }
  /// Numbers of places (frames x particles x 3), which wrap at 2^16: -24576 to 40959 stay distinct. Nothing where a
  /// place lies beyond.
  std::optional<std::vector<std::uint16_t>> numbers_of(std::span<const Points> frames) const;
};
Lattice lattice_around(std::span<const Points> frames);
/// Numbers less those of the same frame of another motion, or of its last one; they wrap.
std::vector<std::uint16_t> subtract_frames(std::vector<std::uint16_t> numbers, std::span<const std::uint16_t> other,
                                           size_t per_frame);

/// Values from 0 to top (those above count as top) in steps of top / 63: as many colours as an eye can distinguish.
std::vector<std::uint16_t> quantise(std::span<const double> values, double top);

// Whole numbers of 16 bits, packed small for the page; unpack.js opens them.
//
// Numbers that belong together (the same coordinate of the same particle, one frame later) lie `lag` apart. Differences
// over that lag are taken `order` times: of what moves evenly nothing is left after the second one. Signs go to the
// lowest bit (zigzag: 0, -1, 1, -2, ... become 0, 1, 2, 3, ...), so that small differences have a high byte of zero,
// all low bytes are put before all high ones, and gzip does the rest. Sums and differences wrap at 2^16: nothing is
// lost.

struct PackedNumbers {
  size_t count;      // numbers
  size_t lag;        // distance of numbers that belong together
  int order;         // how often differences are taken, from number k * lag on the k-th time
  std::string data;  // base64 of gzip
};

/// The same numbers give the same text. Throws std::runtime_error when zlib refuses.
PackedNumbers pack(std::vector<std::uint16_t> numbers, size_t lag, int order);

}  // namespace crosscheck
