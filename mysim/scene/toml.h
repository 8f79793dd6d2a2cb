// TOML: typed look-ups whose errors name file, line and key, and diagnosis of malformed text.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mysim/types.h"

namespace crosscheck {

/// A table of a TOML file. All look-ups throw InputError ("FILE:LINE: KEY: expected ..., got ...") if the value is
/// missing, of the wrong type, not finite or out of range. For a number written as "fit", the message names the command
/// that fits it.
class TomlTable {
 public:
  /// Throws InputError if the text is not TOML; `name` stands for the file in messages.
  static TomlTable parse_text(std::string_view text, const std::string& name);

  const std::string& source() const;     // text of the whole file
  bool has(std::string_view key) const;  // also counts as reading the key

  double number(std::string_view key) const;        // finite
  double positive(std::string_view key) const;      // > 0
  double not_negative(std::string_view key) const;  // >= 0
  static constexpr int greatest_count = 100000000;
  int count(std::string_view key, int most = greatest_count) const;                              // whole, > 0
  std::string text(std::string_view key, std::string_view expected = "a text in quotes") const;  // not empty
  Vec3 vec3(std::string_view key) const;                                                         // finite
  std::vector<int> integers(std::string_view key, int least = 0) const;
  Eigen::VectorXd numbers(std::string_view key, int count) const;  // exactly `count`, finite
  Points points(std::string_view key, int count) const;            // 3 * count numbers, or count triples

  TomlTable section(std::string_view key) const;                   // a table; throws if missing
  std::vector<TomlTable> sections(std::string_view key) const;     // an array of tables; empty if missing
  std::vector<TomlTable> one_or_more(std::string_view key) const;  // a table or an array of tables

  /// Throws InputError "FILE:LINE: KEY: expected EXPECTED".
  [[noreturn]] void fail(std::string_view key, const std::string& expected) const;
  /// Throws InputError if this table or one read from it contains a key that was never read.
  void finish() const;

 private:
  struct Node;
  explicit TomlTable(std::shared_ptr<Node> node);
  std::shared_ptr<Node> node_;
};

/// A TOML file that is modified key by key and written again, without its comments. A path is a dotted name:
/// "grid.stiffness.bend", "spring[2].stiffness".
class TomlDocument {
 public:
  /// Throws like TomlTable::parse_text().
  TomlDocument(std::string_view text, const std::string& name);

  bool has(std::string_view path) const;
  /// Sets a new or existing value. Throws InputError that names the path if its table does not exist.
  void set(std::string_view path, double value);
  void set(std::string_view path, const std::string& value);
  void set(std::string_view path, const std::vector<int>& values);
  /// "sphere[].friction" removes the key from every [[sphere]], and from [sphere].
  void erase(std::string_view path);
  /// Paths of all values equal to this text, in order.
  std::vector<std::string> where(std::string_view value) const;
  std::string text() const;

 private:
  struct Tree;
  std::shared_ptr<Tree> tree_;
};

/// An error in the text: the line (from 1) to correct, which need not be where the parser stumbled, and the remedy.
struct TomlError {
  int line;
  std::string what;
};

/// `line` and `description` are those of the parser; the description is kept if no better diagnosis is known.
TomlError diagnose_toml(std::string_view text, int line, std::string_view description);

/// Error for a key with so many dots that toml++, which recurses for each, would exhaust the stack.
std::optional<TomlError> too_deep_key(std::string_view text);

}  // namespace crosscheck
