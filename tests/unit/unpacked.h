// The page's way back from packed numbers, written apart from the way there.
#pragma once

#include <zlib.h>

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace crosscheck::testing_tools {

inline std::string bytes_of_base64(const std::string& text) {
  static const std::string alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned word = 0;
  int bits = 0;
  for (const char c : text) {
    if (c == '=') break;
    word = word << 6 | static_cast<unsigned>(alphabet.find(c));
    if ((bits += 6) >= 8) bytes += static_cast<char>(word >> (bits -= 8) & 255);
  }
  return bytes;
}

inline std::string gunzipped(std::string bytes, size_t length) {
  std::string out(length, '\0');
  z_stream stream{};
  stream.next_in = reinterpret_cast<Bytef*>(bytes.data()), stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data()), stream.avail_out = static_cast<uInt>(length);
  inflateInit2(&stream, 15 + 16);
  const int status = inflate(&stream, Z_FINISH);
  inflateEnd(&stream);
  if (status != Z_STREAM_END || stream.total_out != length) throw std::runtime_error("not the gzip that was expected");
  return out;
}

inline std::vector<std::uint16_t> unpacked(size_t count, size_t lag, int order, const std::string& data) {
  const std::string planes = gunzipped(bytes_of_base64(data), 2 * count);
  std::vector<std::uint16_t> numbers(count);
  for (size_t i = 0; i < count; ++i) {
    const unsigned low = static_cast<unsigned char>(planes[i]), high = static_cast<unsigned char>(planes[count + i]);
    const unsigned zigzag = low | high << 8;
    numbers[i] = static_cast<std::uint16_t>(zigzag % 2 ? -static_cast<int>((zigzag + 1) / 2) : zigzag / 2);
  }
  for (int k = order; k > 0; --k)
    for (size_t i = static_cast<size_t>(k) * lag; i < count; ++i)
      numbers[i] = static_cast<std::uint16_t>(numbers[i] + numbers[i - lag]);
  return numbers;
}

}  // namespace crosscheck::testing_tools
