// Three ways of quoting, the plainest that fits.
#include "mysim/shell_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string_view>

namespace crosscheck {
namespace {

bool is_control(unsigned char c) { return c < 32 || c == 127; }

/// The length of the UTF-8 character that begins at `at`; 0 where none does.
size_t utf8_length(std::string_view text, size_t at) {
  const auto byte = [&](size_t i) { return static_cast<unsigned char>(at + i < text.size() ? text[at + i] : 0); };
  const unsigned char first = byte(0);
  if (first < 0x80) return 1;
  const size_t length = first >= 0xc2 && first < 0xe0   ? 2
                        : first >= 0xe0 && first < 0xf0 ? 3
                        : first >= 0xf0 && first < 0xf5 ? 4
                                                        : 0;
  for (size_t i = 1; i < length; ++i)
    if ((byte(i) & 0xc0) != 0x80) return 0;
  // overlong forms, surrogates, and what lies above the last character
  if ((first == 0xe0 && byte(1) < 0xa0) || (first == 0xed && byte(1) >= 0xa0) || (first == 0xf0 && byte(1) < 0x90) ||
      (first == 0xf4 && byte(1) >= 0x90))
    return 0;
  return length;
}

std::string escaped(std::string_view word) {
  std::string out = "$'";
  for (size_t i = 0; i < word.size();) {
    const auto c = static_cast<unsigned char>(word[i]);
    const size_t length = utf8_length(word, i);
    if (c == '\n')
      out += "\\n";
    else if (c == '\t')
      out += "\\t";
    else if (c == '\r')
      out += "\\r";
    else if (c == '\'' || c == '\\')
      out += fmt::format("\\{}", word[i]);
    else if (is_control(c) || length == 0)
      out += fmt::format("\\{:03o}", c);  // three digits: the next character cannot run into it
    else
      out += word.substr(i, length);
    i += std::max<size_t>(1, length);
  }
  return out + "'";
}

}  // namespace

std::string shell_word(const std::string& word) {
  bool plain = !word.empty(), one_line = true;
  for (size_t i = 0; i < word.size();) {
    const auto c = static_cast<unsigned char>(word[i]);
    const size_t length = utf8_length(word, i);
    if (is_control(c) || length == 0) one_line = false;
    if (c < 0x80 && !std::isalnum(c) && std::string_view("_-+=.,/:@%").find(word[i]) == std::string_view::npos)
      plain = false;
    i += std::max<size_t>(1, length);
  }
  if (!one_line) return escaped(word);
  if (plain) return word;
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? "'\\''" : std::string(1, c);
  return out + "'";
}

std::string shell_line(std::span<const std::string> words) {
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : " ") + shell_word(word);
  return line;
}

}  // namespace crosscheck
