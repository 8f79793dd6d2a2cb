// Distances between words, for proposals.
#include "mysim/nearest.h"

#include <algorithm>
#include <cctype>

namespace crosscheck {
namespace {

std::string folded_word(std::string_view word) {
  std::string out;
  for (const char c : word)
    out += c == '_' || c == ' ' ? '-' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

/// Optimal string alignment: additions, omissions, exchanges and swaps of neighbours, each letter touched once.
std::size_t letters_between(const std::string& a, const std::string& b) {
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

std::string nearest(std::string_view word, const std::vector<std::string>& names) {
  const std::string asked = folded_word(word.substr(0, 100));
  const std::string* best = nullptr;
  std::size_t fewest = 0;
  for (const std::string& name : names) {
    const std::string candidate = folded_word(name);
    const std::size_t longer = std::max(asked.size(), candidate.size()), letters = letters_between(asked, candidate);
    if (letters > std::max<std::size_t>(1, longer / 3) || letters >= std::min(asked.size(), candidate.size())) continue;
    if (!best || letters < fewest) best = &name, fewest = letters;
  }
  if (!best)
    for (const std::string& name : names)
      if (has_part(folded_word(name), asked) && (!best || name.size() < best->size())) best = &name;
  if (!best)
    for (const std::string& name : names)
      if (name.size() >= 4 && has_part(asked, folded_word(name)) && (!best || name.size() > best->size())) best = &name;
  std::size_t longest = 4;  // letters of a beginning that are no chance
  if (!best)
    for (const std::string& name : names) {
      const std::string candidate = folded_word(name);
      const auto alike = static_cast<std::size_t>(
          std::mismatch(asked.begin(), asked.end(), candidate.begin(), candidate.end()).first - asked.begin());
      if (alike > longest) best = &name, longest = alike;
    }
  return best ? *best : "";
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& names) {
  const std::string name = nearest(word, names);
  return name.empty() ? "" : "; did you mean '" + name + "'?";
}

}  // namespace crosscheck
