#include "mysim/base/pattern.h"

#include <regex>

namespace crosscheck {

struct Pattern::Compiled {
  std::regex regex;
};

Pattern::Pattern(std::string_view expression)
    : compiled_(new Compiled{std::regex(expression.begin(), expression.end())}) {}
Pattern::~Pattern() = default;

std::optional<std::vector<std::string>> Pattern::match(const std::string& text) const {
  std::smatch parts;
  if (!std::regex_match(text, parts, compiled_->regex)) return std::nullopt;
  return std::vector<std::string>(parts.begin(), parts.end());
}

bool Pattern::is_in(const std::string& text) const { return std::regex_search(text, compiled_->regex); }

std::string Pattern::replaced_in(const std::string& text, const std::string& by) const {
  return std::regex_replace(text, compiled_->regex, by);
}

}  // namespace crosscheck
