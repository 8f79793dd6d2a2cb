#include "mysim/base/pattern.h"

#include <fnmatch.h>

#include <regex>

namespace crosscheck {

// std::regex needs stack for each character: 8 MB suffice for three times this length, even with sanitizers
constexpr size_t longest = 4000;

struct Pattern::Compiled {
  std::regex regex;
};

Pattern::Pattern(std::string_view expression)
    : compiled_(new Compiled{std::regex(expression.begin(), expression.end())}) {}
Pattern::~Pattern() = default;

std::optional<std::vector<std::string>> Pattern::match(const std::string& text) const {
  std::smatch parts;
  if (text.size() > longest || !std::regex_match(text, parts, compiled_->regex)) return std::nullopt;
  return std::vector<std::string>(parts.begin(), parts.end());
}

bool Pattern::is_in(const std::string& text) const {
  return text.size() <= longest && std::regex_search(text, compiled_->regex);
}

std::string Pattern::replaced_in(const std::string& text, const std::string& by) const {
  return text.size() > longest ? text : std::regex_replace(text, compiled_->regex, by);
}

bool glob_matches(const std::string& glob, const std::string& text) {
  return fnmatch(glob.c_str(), text.c_str(), FNM_EXTMATCH) == 0;
}

}  // namespace crosscheck
