// Independent readers of cairo's PDFs and the page's packed numbers.
#pragma once

#include <gtest/gtest.h>
#include <zlib.h>

#include <cstdint>
#include <regex>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "mysim/base/json.h"

namespace crosscheck::testing_tools {

/// The streams of a PDF, decompressed by zlib.
inline std::vector<std::string> streams_of(const std::string& pdf) {
  std::vector<std::string> streams;
  const std::string begin = "stream\n";
  for (size_t at = pdf.find(begin); at != std::string::npos; at = pdf.find(begin, at + 1)) {
    std::string text(1 << 24, ' ');
    uLongf size = text.size();
    const size_t from = at + begin.size();
    uLong rest = pdf.size() - from;
    if (uncompress2(reinterpret_cast<Bytef*>(text.data()), &size, reinterpret_cast<const Bytef*>(pdf.data() + from),
                    &rest) == Z_OK)
      streams.push_back(text.substr(0, size));
  }
  return streams;
}

/// Size of the first page in points. The size may be in a compressed stream, because cairo compresses the page's
/// description since version 1.18.
inline std::pair<double, double> page_of(const std::string& pdf) {
  std::vector<std::string> texts = streams_of(pdf);
  texts.insert(texts.begin(), pdf);
  std::smatch found;
  for (const std::string& text : texts)
    if (std::regex_search(text, found, std::regex("/MediaBox \\[ ?[0-9.]+ [0-9.]+ ([0-9.]+) ([0-9.]+)")))
      return {std::stod(found[1]), std::stod(found[2])};
  ADD_FAILURE() << "no page has a size";
  return {};
}

/// Sizes of the letters in a PDF, in points.
inline std::set<double> letters_of(const std::string& pdf) {
  std::set<double> sizes;
  for (const std::string& text : streams_of(pdf)) {
    if (text.find(" Tm") == std::string::npos) continue;
    const std::regex matrix("([-0-9.]+) ([-0-9.]+) [-0-9.]+ [-0-9.]+ [-0-9.]+ [-0-9.]+ Tm");
    for (std::sregex_iterator i(text.begin(), text.end(), matrix), end; i != end; ++i)
      sizes.insert(std::hypot(std::stod((*i)[1]), std::stod((*i)[2])));
  }
  return sizes;
}

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

/// The text in gzip data that are encoded in base64.
inline std::string unpacked_text(const std::string& base64) {
  const std::string bytes = bytes_of_base64(base64);
  size_t length = 0;  // the last four bytes of a gzip file
  for (size_t i = 1; i <= 4; ++i) length = length << 8 | static_cast<unsigned char>(bytes.at(bytes.size() - i));
  return gunzipped(bytes, length);
}

/// Returns the page with the contents of folds inserted.
inline std::string with_folds_put_back(std::string page) {
  const std::string begin = "<script type=\"text/plain\" id=\"held\">";
  const size_t from = page.find(begin);
  if (from == std::string::npos) return page;
  const size_t text = from + begin.size();
  const JsonField folds = JsonField::parse(unpacked_text(page.substr(text, page.find('<', text) - text)), "folds");
  int i = 0;
  for (const JsonField& fold : folds.elements()) {
    const std::string mark = " data-held=\"" + std::to_string(i++) + "\">";
    const size_t at = page.find(mark);
    if (at == std::string::npos)
      ADD_FAILURE() << "no template for fold " << i - 1;
    else
      page.replace(at, mark.size(), ">" + fold.text());
  }
  return page;
}

/// Rows of numbers, as in report/CONTRACT.md.
inline std::vector<std::uint16_t> unpacked(const std::string& gzip, size_t count, size_t columns) {
  const std::string planes = gunzipped(gzip, 2 * count);
  std::vector<std::uint16_t> numbers(count);
  for (size_t i = 0; i < count; ++i) {
    const unsigned low = static_cast<unsigned char>(planes[i]), high = static_cast<unsigned char>(planes[count + i]);
    const unsigned zigzag = low | high << 8;
    numbers[i] = static_cast<std::uint16_t>(zigzag % 2 ? -static_cast<int>((zigzag + 1) / 2) : zigzag / 2);
    if (i >= columns) numbers[i] = static_cast<std::uint16_t>(numbers[i] + numbers[i - columns]);
  }
  return numbers;
}

}  // namespace crosscheck::testing_tools
