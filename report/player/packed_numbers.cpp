#include "report/player/packed_numbers.h"

#include <zlib.h>

#include <stdexcept>

namespace crosscheck {
namespace {

constexpr int gzip_format = 15 + 16;  // zlib's code for a window of 32 kB and gzip's header

Bytef* bytes_of(std::string_view bytes) { return reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data())); }

/// Unpacks exactly `size` bytes.
std::string gunzipped(std::string_view bytes, size_t size) {
  constexpr size_t densest = 1032;  // deflate's largest ratio, which limits the size that a received file may claim
  if (size / densest > bytes.size()) throw std::runtime_error("packed numbers end too early");
  std::string out(size, '\0');
  z_stream stream{};
  stream.next_in = bytes_of(bytes), stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = bytes_of(out), stream.avail_out = static_cast<uInt>(out.size());
  if (inflateInit2(&stream, gzip_format) != Z_OK) throw std::runtime_error("zlib cannot begin to read");
  const int status = inflate(&stream, Z_FINISH);
  const bool whole = status == Z_STREAM_END && stream.total_out == size && stream.avail_in == 0;
  inflateEnd(&stream);
  if (!whole) throw std::runtime_error("not as many packed numbers as stated");
  return out;
}

}  // namespace

std::string gzipped(std::string_view bytes) {
  z_stream stream{};
  if (deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, gzip_format, 9, Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::runtime_error("zlib cannot begin to compress");
  std::string out(deflateBound(&stream, bytes.size()), '\0');
  stream.next_in = bytes_of(bytes), stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = bytes_of(out), stream.avail_out = static_cast<uInt>(out.size());
  const int status = deflate(&stream, Z_FINISH);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  if (status != Z_STREAM_END) throw std::runtime_error("zlib cannot compress");
  return out;
}

std::string pack(std::vector<std::uint16_t> numbers, size_t columns) {
  const size_t count = numbers.size();
  for (size_t i = count; i-- > columns;) numbers[i] = static_cast<std::uint16_t>(numbers[i] - numbers[i - columns]);
  std::string planes(2 * count, '\0');
  for (size_t i = 0; i < count; ++i) {
    const auto difference = static_cast<std::int16_t>(numbers[i]);
    const auto zigzag = static_cast<std::uint16_t>(difference < 0 ? ~(2 * difference) : 2 * difference);
    planes[i] = static_cast<char>(zigzag & 255);
    planes[count + i] = static_cast<char>(zigzag >> 8);
  }
  return gzipped(planes);
}

std::vector<std::uint16_t> unpack(std::string_view bytes, size_t count, size_t columns) {
  const std::string planes = gunzipped(bytes, 2 * count);
  std::vector<std::uint16_t> numbers(count);
  for (size_t i = 0; i < count; ++i) {
    const int zigzag = static_cast<unsigned char>(planes[i]) | static_cast<unsigned char>(planes[count + i]) << 8;
    const int difference = zigzag % 2 == 0 ? zigzag / 2 : -(zigzag / 2) - 1;
    numbers[i] = static_cast<std::uint16_t>(difference + (i >= columns ? numbers[i - columns] : 0));
  }
  return numbers;
}

}  // namespace crosscheck
