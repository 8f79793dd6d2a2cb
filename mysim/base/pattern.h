// Regular expressions and glob patterns; only pattern.cpp includes <regex>, which takes seconds to compile.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace crosscheck {

/// A regular expression in ECMAScript's grammar. Throws std::regex_error if it is invalid.
class Pattern {
 public:
  explicit Pattern(std::string_view expression);
  ~Pattern();
  Pattern(const Pattern&) = delete;
  Pattern& operator=(const Pattern&) = delete;

  /// The match of the whole text and its groups ("" for a group that did not participate), or nothing.
  std::optional<std::vector<std::string>> match(const std::string& text) const;
  /// True if any part of the text matches.
  bool is_in(const std::string& text) const;
  /// Replaces all matches; $1 refers to the first group.
  std::string replaced_in(const std::string& text, const std::string& by) const;

 private:
  struct Compiled;
  std::unique_ptr<Compiled> compiled_;
};

/// True if the whole text matches the glob pattern, which may contain !(A|B) and @(A|B).
bool glob_matches(const std::string& glob, const std::string& text);

}  // namespace crosscheck
