// Regular expressions, behind one file: <regex> takes the compiler seconds wherever it is included.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace crosscheck {

/// A regular expression in ECMAScript's grammar. Throws std::regex_error where it is none.
class Pattern {
 public:
  explicit Pattern(std::string_view expression);
  ~Pattern();
  Pattern(const Pattern&) = delete;
  Pattern& operator=(const Pattern&) = delete;

  /// Where the whole text is a match: the match, and each group of it ("" where it took no part).
  std::optional<std::vector<std::string>> match(const std::string& text) const;
  /// Whether a part of the text is a match.
  bool is_in(const std::string& text) const;
  /// Each match replaced; $1 stands for its first group.
  std::string replaced_in(const std::string& text, const std::string& by) const;

 private:
  struct Compiled;
  std::unique_ptr<Compiled> compiled_;
};

}  // namespace crosscheck
