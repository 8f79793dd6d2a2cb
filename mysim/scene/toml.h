// TOML: typed look-ups with file, line and key in their errors, and diagnosis of malformed text.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mysim/types.h"

namespace crosscheck {

// One table of a scene file, with typed look-ups that remember which keys were read.

/// A table of a TOML file. Every look-up throws InputError ("FILE:LINE: KEY: expected ..., got ...") if the value is
/// missing, of the wrong type, not finite or out of range. For a number written as "fit", the message names the command
/// that fits it. finish() throws at the first key that was never looked up.
class TomlTable {
 public:
  /// Throws InputError if the text is not TOML; `name` replaces the file name in messages.
  static TomlTable parse_text(std::string_view text, const std::string& name);

  const std::string& source() const;     // text of the whole file
  bool has(std::string_view key) const;  // also marks the key as known

  double number(std::string_view key) const;        // any finite number
  double positive(std::string_view key) const;      // > 0
  double not_negative(std::string_view key) const;  // >= 0
  static constexpr int greatest_count = 100000000;
  int count(std::string_view key, int most = greatest_count) const;                              // whole number > 0
  std::string text(std::string_view key, std::string_view expected = "a text in quotes") const;  // not empty
  Vec3 vec3(std::string_view key) const;                                                         // three finite numbers
  std::vector<int> integers(std::string_view key, int least = 0) const;
  Eigen::VectorXd numbers(std::string_view key, int count) const;  // exactly `count` finite numbers
  Points points(std::string_view key, int count) const;            // 3 `count` numbers, or `count` triples

  TomlTable section(std::string_view key) const;                   // a table; throws if it is missing
  std::vector<TomlTable> sections(std::string_view key) const;     // an array of tables; empty if it is missing
  std::vector<TomlTable> one_or_more(std::string_view key) const;  // a table, or an array of tables

  /// Throws InputError at the line of the key: "FILE:LINE: KEY: expected EXPECTED".
  [[noreturn]] void fail(std::string_view key, const std::string& expected) const;
  /// Throws InputError if the table or a section below contains a key that was never read.
  void finish() const;

 private:
  struct Node;
  explicit TomlTable(std::shared_ptr<Node> node);
  std::shared_ptr<Node> node_;
};

/// A TOML file that is modified key by key and written again (without its comments). A path is a dotted name:
/// "grid.stiffness.bend", "spring[2].stiffness".
class TomlDocument {
 public:
  /// Throws InputError if the text is not TOML; `name` replaces the file name in messages.
  TomlDocument(std::string_view text, const std::string& name);

  bool has(std::string_view path) const;
  /// Sets a new or existing value in an existing table. Throws InputError that names the path if there is no such
  /// table.
  void set(std::string_view path, double value);
  void set(std::string_view path, const std::string& value);
  void set(std::string_view path, const std::vector<int>& values);
  /// Removes the key, if present. "sphere[].friction" addresses the key in every [[sphere]], and in [sphere].
  void erase(std::string_view path);
  /// Paths of all values equal to this text, in the order of the keys.
  std::vector<std::string> where(std::string_view value) const;
  std::string text() const;

 private:
  struct Tree;
  std::shared_ptr<Tree> tree_;
};

// Diagnosis of malformed TOML: the line to correct, and how.

/// An error in the text: the line (from 1) to correct, which need not be the one where the parser stumbled, and the
/// correction.
struct TomlError {
  int line;
  std::string what;
};

/// line, description: position and message of the parser; the message is kept if no better diagnosis is known.
TomlError diagnose_toml(std::string_view text, int line, std::string_view description);

/// Error for a key with so many dots that toml++, which recurses once per dot, would exhaust the stack.
std::optional<TomlError> too_deep_key(std::string_view text);

}  // namespace crosscheck
