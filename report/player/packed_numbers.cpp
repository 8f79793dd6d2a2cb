// Differences, zigzag, byte planes, gzip, Base64.
#include "report/player/packed_numbers.h"

#include <zlib.h>

#include <stdexcept>

#include "mysim/base/text.h"

namespace crosscheck {

std::string gzipped(std::string bytes) {
  constexpr int gzip_format = 15 + 16;  // zlib's word for a window of 32 kB and gzip's header, which browsers read
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

PackedNumbers pack_small(const std::vector<std::uint16_t>& numbers) {
  PackedNumbers best = pack(numbers, 1, 0);
  for (const size_t lag : {1, 3})
    for (const int order : {1, 2})
      if (PackedNumbers other = pack(numbers, lag, order); other.data.size() < best.data.size())
        best = std::move(other);
  return best;
}

namespace {

std::string from_base64(std::string_view text) {
  static constexpr std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3);
  unsigned word = 0;
  int bits = 0;
  for (const char sign : text) {
    const size_t value = alphabet.find(sign);
    if (value == std::string_view::npos) break;
    word = word << 6 | static_cast<unsigned>(value);
    if ((bits += 6) >= 8) bytes += static_cast<char>(word >> (bits -= 8) & 255);
  }
  return bytes;
}

/// Of a text that becomes so many bytes.
std::string inflated(std::string bytes, size_t count) {
  constexpr size_t densest = 1032;  // bytes that deflate makes one of at most
  if (count / densest > bytes.size()) throw std::runtime_error("packed numbers end too early");
  std::string out(count, '\0');
  constexpr int gzip_format = 15 + 16;
  z_stream stream{};
  stream.next_in = reinterpret_cast<Bytef*>(bytes.data());
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  if (inflateInit2(&stream, gzip_format) != Z_OK) throw std::runtime_error("zlib cannot begin to read");
  inflate(&stream, Z_FINISH);
  const bool whole = stream.total_out == count;
  inflateEnd(&stream);
  if (!whole) throw std::runtime_error("packed numbers end too early");
  return out;
}

}  // namespace

std::vector<std::uint16_t> unpack(const PackedNumbers& packed) {
  if (packed.count == 0) return {};
  const std::string planes = inflated(from_base64(packed.data), 2 * packed.count);
  std::vector<std::uint16_t> numbers(packed.count);
  for (size_t i = 0; i < packed.count; ++i) {
    const auto zigzag = static_cast<unsigned char>(planes[i]) | static_cast<unsigned char>(planes[packed.count + i])
                                                                    << 8;
    numbers[i] = static_cast<std::uint16_t>(zigzag % 2 == 0 ? zigzag / 2 : -(zigzag / 2) - 1);
  }
  // a larger lag reaches no number, and its double may be too large for a size
  for (int k = packed.lag < packed.count ? packed.order : 0; k >= 1; --k)
    for (size_t i = static_cast<size_t>(k) * packed.lag; i < packed.count; ++i)
      numbers[i] = static_cast<std::uint16_t>(numbers[i] + numbers[i - packed.lag]);
  return numbers;
}

}  // namespace crosscheck
