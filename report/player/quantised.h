// Places and colour values as small whole numbers: as fine as a picture can show, and no finer.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "mysim/types.h"

namespace crosscheck {

/// Places on a lattice of 2^14 points along each axis of the box around them.
struct QuantisedPlaces {
  Vec3 low, unit;  // m: place = low + unit * number, axis by axis
  /// m, no place is further from its number's than this: half a unit along each axis, sqrt(ux^2 + uy^2 + uz^2) / 2, and
  /// a part in 10^12 of the box for the roundings of doubles. For a box of 2 m it is at most 0.11 mm.
  double bound;
  std::vector<std::uint16_t> numbers;  // frames x particles x 3
};
/// The places must be finite.
QuantisedPlaces quantised(std::span<const Points> frames);

/// A lattice that the motions of a scene share: the box around the first one has 2^14 points along its longest side.
struct Lattice {
  Vec3 low;
  double unit;  // m, along each axis
  /// m, no place is further from its number's.
  double bound() const { return unit * std::sqrt(3.) / 2 + 1e-12 * low.norm(); }
  /// Numbers of places (frames x particles x 3), which wrap at 2^16: -24576 to 40959 are told apart. Nothing where a
  /// place lies beyond.
  std::optional<std::vector<std::uint16_t>> numbers_of(std::span<const Points> frames) const;
};
Lattice lattice_around(std::span<const Points> frames);
/// Numbers less those of the same frame of another motion, or of its last one; they wrap.
std::vector<std::uint16_t> less(std::vector<std::uint16_t> numbers, std::span<const std::uint16_t> other,
                                size_t per_frame);

/// Values from 0 to top (those above count as top) in steps of top / 63: as many colours as an eye tells apart.
std::vector<std::uint16_t> quantised(std::span<const double> values, double top);

}  // namespace crosscheck
