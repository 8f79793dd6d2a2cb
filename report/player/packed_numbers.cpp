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

}  // namespace crosscheck
