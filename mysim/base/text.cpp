#include "mysim/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string_view>

#include "mysim/base/errors.h"

namespace crosscheck {
namespace {

std::string folded_word(std::string_view word) {
  std::string out;
  for (const char c : word)
    out += c == '_' || c == ' ' ? '-' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

/// Optimal string alignment distance: insertions, deletions, substitutions and transpositions of neighbours, where each
/// letter is edited at most once.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i)
    for (std::size_t j = 1; j <= b.size(); ++j) {
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  return d[a.size()][b.size()];
}

bool has_part(const std::string& name, const std::string& word) {
  if (word.size() < 3) return name.starts_with(word) && !word.empty();
  for (std::size_t at = name.find(word); at != std::string::npos; at = name.find(word, at + 1))
    if (at == 0 || name[at - 1] == '-' || name[at - 1] == '/') return true;
  return false;
}

}  // namespace

std::string closest_match(std::string_view word, const std::vector<std::string>& names) {
  const std::string folded = folded_word(word.substr(0, 100));
  const std::string* best = nullptr;
  std::pair<int, long> fewest;  // kind of match, then its cost
  for (const std::string& name : names) {
    const std::string candidate = folded_word(name);
    const long longer = std::max(std::ssize(folded), std::ssize(candidate));
    const long shorter = std::min(std::ssize(folded), std::ssize(candidate));
    const auto letters = static_cast<long>(edit_distance(folded, candidate));
    const long alike =
        std::mismatch(folded.begin(), folded.end(), candidate.begin(), candidate.end()).first - folded.begin();
    std::pair<int, long> cost;
    if (letters <= std::max(1L, longer / 3) && letters < shorter)
      cost = {0, letters};
    else if (has_part(candidate, folded))
      cost = {1, std::ssize(name)};
    else if (name.size() >= 4 && has_part(folded, candidate))
      cost = {2, -std::ssize(name)};
    else if (alike > 4)
      cost = {3, -alike};
    else
      continue;
    if (!best || cost < fewest) best = &name, fewest = cost;
  }
  return best ? *best : "";
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& names) {
  const std::string name = closest_match(word, names);
  return name.empty() ? "" : "; did you mean '" + name + "'?";
}

std::string unknown_name(std::string_view kind, std::string_view word, const std::vector<std::string>& names,
                         std::string_view list) {
  constexpr std::size_t longest = 60;  // bytes of the word that are shown in a message of at most 200 bytes
  std::string shown(word);
  if (shown.size() > longest) {
    std::size_t end = longest - 3;
    while (end > 0 && (static_cast<unsigned char>(shown[end]) & 0xc0) == 0x80) --end;  // not inside a UTF-8 character
    shown = shown.substr(0, end) + "...";
  }
  const std::string near = closest_match(word, names);
  return near.empty() || near.size() > longest
             ? fmt::format("unknown {} '{}'; `{}` shows all", kind, shown, list)
             : fmt::format("unknown {} '{}'; did you mean '{}'? (`{}` shows all)", kind, shown, near, list);
}

void refuse_option(const std::string& method, const std::string& option, const std::string& known) {
  std::vector<std::string> options;
  for (size_t at = known.find('+'); at != std::string::npos; at = known.find('+', at + 1))
    options.push_back(known.substr(at + 1, known.find_first_of(" ,;", at) - at - 1));
  throw InputError(fmt::format("method {}: unknown option '+{}'; expected {}{}", method, option, known,
                               did_you_mean(option, options)));
}

std::vector<std::string> split(std::string_view text, char separator) {
  std::vector<std::string> parts;
  size_t begin = 0;
  for (size_t end; (end = text.find(separator, begin)) != std::string_view::npos; begin = end + 1)
    parts.emplace_back(text.substr(begin, end - begin));
  parts.emplace_back(text.substr(begin));
  return parts;
}

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
  // overlong forms, surrogates, code points above U+10FFFF
  if ((first == 0xe0 && byte(1) < 0xa0) || (first == 0xed && byte(1) >= 0xa0) || (first == 0xf0 && byte(1) < 0x90) ||
      (first == 0xf4 && byte(1) >= 0x90))
    return 0;
  return length;
}

std::string shell_quote(const std::string& word) {
  bool plain = !word.empty(), printable = true;
  std::string escaped;
  for (size_t i = 0, length; i < word.size(); i += std::max<size_t>(1, length)) {
    length = utf8_length(word, i);
    const auto c = static_cast<unsigned char>(word[i]);
    const bool shown = length > 0 && c >= 32 && c != 127;
    if (!shown)
      escaped += fmt::format("\\{:03o}", c);  // always three digits, because bash reads up to three
    else
      escaped += (c == '\'' || c == '\\' ? "\\" : "") + word.substr(i, length);
    plain &= shown &&
             (c >= 0x80 || std::isalnum(c) || std::string_view("_-+=.,/:@%").find(word[i]) != std::string_view::npos);
    printable &= shown;
  }
  return plain ? word : printable ? shell_single_quote(word) : "$'" + escaped + "'";
}

std::string shell_single_quote(const std::string& word) {
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? "'\\''" : std::string(1, c);
  return out + "'";
}

std::string shell_join(std::span<const std::string> words) {
  std::string line;
  for (const std::string& word : words) line += (line.empty() ? "" : " ") + shell_quote(word);
  return line;
}

std::string format_bytes(double bytes) {
  const char* units[] = {"B", "kB", "MB", "GB", "TB", "PB", "EB"};
  int unit = 0;
  while (bytes >= 999.5 && unit < 6) bytes /= 1000, ++unit;
  return unit == 6 && bytes >= 999.5 ? fmt::format("{:.2g} EB", bytes) : fmt::format("{:.3g} {}", bytes, units[unit]);
}

std::string base64(std::string_view bytes) {
  static constexpr char alphabet[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  unsigned word = 0;
  int bits = 0;
  for (const char byte : bytes)
    for (word = word << 8 | static_cast<unsigned char>(byte), bits += 8; bits >= 6; bits -= 6)
      out += alphabet[word >> (bits - 6) & 63];
  if (bits > 0) out += alphabet[word << (6 - bits) & 63];
  while (out.size() % 4 != 0) out += '=';
  return out;
}

}  // namespace crosscheck
