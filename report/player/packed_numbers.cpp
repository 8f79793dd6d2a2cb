// Quantisation; differences, zigzag, byte planes, gzip, Base64.
#include "report/player/packed_numbers.h"

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "mysim/base/text.h"

namespace crosscheck {
namespace {

constexpr double places_along_axis = (1 << 14) - 1;
constexpr double value_steps = 63;

}  // namespace

QuantisedPositions quantise(std::span<const Points> frames) {
  Vec3 low = Vec3::Constant(INFINITY), high = -low;
  for (const Points& x : frames) {
    low = low.cwiseMin(x.rowwise().minCoeff());
    high = high.cwiseMax(x.rowwise().maxCoeff());
  }
  QuantisedPositions out{low, (high - low) / places_along_axis, 0, {}};
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
  const QuantisedPositions box = quantise(frames);
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

std::vector<std::uint16_t> subtract_frames(std::vector<std::uint16_t> numbers, std::span<const std::uint16_t> other,
                                           size_t per_frame) {
  const size_t last = other.size() - per_frame;
  for (size_t i = 0; i < numbers.size(); ++i)
    numbers[i] = static_cast<std::uint16_t>(numbers[i] - other[std::min(i - i % per_frame, last) + i % per_frame]);
  return numbers;
}

std::vector<std::uint16_t> quantise(std::span<const double> values, double top) {
  std::vector<std::uint16_t> out;
  for (const double value : values)
    out.push_back(static_cast<std::uint16_t>(std::round(value_steps * std::clamp(value / top, 0.0, 1.0))));
  return out;
}

namespace {

constexpr int gzip_format = 15 + 16;  // zlib's word for a window of 32 kB and gzip's header, which browsers read

std::string gzipped(std::string bytes) {
  z_stream stream{};
  if (deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, gzip_format, 9, Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::runtime_error("zlib cannot begin to compress");
  std::string out(deflateBound(&stream, bytes.size()), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(bytes.data());
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  const int status = deflate(&stream, Z_FINISH);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  if (status != Z_STREAM_END) throw std::runtime_error("zlib cannot compress");
  return out;
}

}  // namespace

PackedNumbers pack(std::vector<std::uint16_t> numbers, size_t lag, int order) {
  const size_t count = numbers.size();
  for (int k = 1; k <= order; ++k)
    for (size_t i = count; i-- > static_cast<size_t>(k) * lag;)
      numbers[i] = static_cast<std::uint16_t>(numbers[i] - numbers[i - lag]);
  std::string planes(2 * count, '\0');
  for (size_t i = 0; i < count; ++i) {
    const auto difference = static_cast<std::int16_t>(numbers[i]);
    const auto zigzag = static_cast<std::uint16_t>(difference < 0 ? ~(2 * difference) : 2 * difference);
    planes[i] = static_cast<char>(zigzag & 255);
    planes[count + i] = static_cast<char>(zigzag >> 8);
  }
  return {count, lag, order, base64(gzipped(std::move(planes)))};
}

}  // namespace crosscheck
