// Rounds places and values to lattices.
#include "report/player/quantised.h"

#include <algorithm>
#include <cmath>

namespace crosscheck {
namespace {

constexpr double places_along_axis = (1 << 14) - 1;
constexpr double value_steps = 63;

}  // namespace

QuantisedPlaces quantised(std::span<const Points> frames) {
  Vec3 low = Vec3::Constant(INFINITY), high = -low;
  for (const Points& x : frames) {
    low = low.cwiseMin(x.rowwise().minCoeff());
    high = high.cwiseMax(x.rowwise().maxCoeff());
  }
  QuantisedPlaces out{low, (high - low) / places_along_axis, 0, {}};
  out.bound = out.unit.norm() / 2 + 1e-12 * std::max(low.norm(), high.norm());
  // where all lies in a plane every number is zero
  const Vec3 per_metre = out.unit.unaryExpr([](double u) { return u > 0 ? 1 / u : 0; });
  for (const Points& x : frames)
    for (Eigen::Index i = 0; i < x.cols(); ++i)
      for (int k = 0; k < 3; ++k)
        out.numbers.push_back(static_cast<std::uint16_t>(
            std::clamp(std::round((x(k, i) - low[k]) * per_metre[k]), 0.0, places_along_axis)));
  return out;
}

Lattice lattice_around(std::span<const Points> frames) {
  const QuantisedPlaces box = quantised(frames);
  const double unit = box.unit.maxCoeff();
  return {box.low, unit > 0 ? unit : 1 / places_along_axis};  // a single place: a metre
}

std::optional<std::vector<std::uint16_t>> Lattice::numbers_of(std::span<const Points> frames) const {
  constexpr long lowest = -24576, highest = lowest + 65535;
  std::vector<std::uint16_t> out;
  for (const Points& x : frames)
    for (Eigen::Index i = 0; i < x.cols(); ++i)
      for (int k = 0; k < 3; ++k) {
        const double number = std::round((x(k, i) - low[k]) / unit);
        if (!(number >= lowest && number <= highest)) return std::nullopt;
        out.push_back(static_cast<std::uint16_t>(static_cast<long>(number)));
      }
  return out;
}

std::vector<std::uint16_t> less(std::vector<std::uint16_t> numbers, std::span<const std::uint16_t> other,
                                size_t per_frame) {
  const size_t last = other.size() - per_frame;
  for (size_t i = 0; i < numbers.size(); ++i)
    numbers[i] = static_cast<std::uint16_t>(numbers[i] - other[std::min(i - i % per_frame, last) + i % per_frame]);
  return numbers;
}

std::vector<std::uint16_t> quantised(std::span<const double> values, double top) {
  std::vector<std::uint16_t> out;
  for (const double value : values)
    out.push_back(static_cast<std::uint16_t>(std::round(value_steps * std::clamp(value / top, 0.0, 1.0))));
  return out;
}

}  // namespace crosscheck
