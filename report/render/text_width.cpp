// Advance widths of DejaVu Sans and DejaVu Sans Bold, taken from the fonts, for the printable ASCII letters.
#include "report/render/text_width.h"

#include <array>

namespace crosscheck::render {
namespace {

// hundredths of the font size, from ' ' to '~'
// clang-format off
constexpr std::array<unsigned char, 95> regular = {
    32, 40, 46, 84, 64, 95, 78, 27, 39, 39, 50, 84, 32, 36, 32, 34, 64, 64, 64, 64, 64, 64, 64, 64, 64, 64, 34, 34, 84, 84,
    84, 53, 100, 68, 69, 70, 77, 63, 58, 77, 75, 29, 29, 66, 56, 86, 75, 79, 60, 79, 69, 63, 61, 73, 68, 99, 69, 61, 69, 39,
    34, 39, 84, 50, 50, 61, 63, 55, 63, 62, 35, 63, 63, 28, 28, 58, 28, 97, 63, 61, 63, 63, 41, 52, 39, 63, 59, 82, 59, 59,
    52, 64, 34, 64, 84};
constexpr std::array<unsigned char, 95> heavy = {
    35, 46, 52, 84, 70, 100, 87, 31, 46, 46, 52, 84, 38, 42, 38, 37, 70, 70, 70, 70, 70, 70, 70, 70, 70, 70, 40, 40, 84, 84,
    84, 58, 100, 77, 76, 73, 83, 68, 68, 82, 84, 37, 37, 77, 64, 100, 84, 85, 73, 85, 77, 72, 68, 81, 77, 110, 77, 72, 73,
    46, 37, 46, 84, 50, 50, 67, 72, 59, 72, 68, 44, 72, 71, 34, 34, 67, 34, 104, 71, 69, 72, 72, 49, 60, 48, 71, 65, 92, 65,
    65, 58, 71, 37, 71, 84};
// clang-format on
constexpr int other = 84;

}  // namespace

double text_width(const std::string& text, bool bold) {
  int sum = 0;
  for (const char letter : text) {
    const auto byte = static_cast<unsigned char>(letter);
    if (byte >= 0x80 && byte < 0xC0) continue;  // the rest of a letter of several bytes
    const bool printable = byte >= 32 && byte < 127;
    sum += printable ? (bold ? heavy : regular)[byte - 32u] : other;
  }
  return sum / 100.0;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines(1);
  for (const char letter : text)
    if (letter == '\n')
      lines.emplace_back();
    else
      lines.back() += letter;
  return lines;
}

std::string wrapped(const std::string& text, bool bold, double room) {
  std::vector<std::string> pieces(1);
  for (const char letter : text) {
    const std::string& last = pieces.back();
    if (last.ends_with('/') || last.ends_with(", ") || (letter == '+' && !last.empty())) pieces.emplace_back();
    pieces.back() += letter;
  }
  std::string line, all;
  for (const std::string& piece : pieces) {
    if (!line.empty() && text_width(line + piece, bold) > room) {
      while (line.ends_with(' ')) line.pop_back();
      all += line + "\n", line.clear();
    }
    line += piece;
  }
  return all + line;
}

}  // namespace crosscheck::render
