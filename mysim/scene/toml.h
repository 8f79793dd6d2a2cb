// TOML: typed look-ups that name file, line and key when they fail, and what is wrong with text that is none.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mysim/types.h"

namespace crosscheck {

// One table of a scene file: typed look-ups that name file, line and key when they fail, and remember what was read.

/// A table of a TOML file. Every look-up throws InputError ("FILE:LINE: KEY: expected ..., got ...") when the value is
/// missing, of the wrong type, not finite or out of range; of a number written as "fit" it names the command that fits
/// it. finish() throws on the first key that was never looked up.
class TomlTable {
 public:
  /// Throws InputError where it is no TOML; name stands for the file in messages.
  static TomlTable parse_text(std::string_view text, const std::string& name);

  const std::string& source() const;     // the text of the whole file
  bool has(std::string_view key) const;  // also makes the key a known one

  double number(std::string_view key) const;        // any finite number
  double positive(std::string_view key) const;      // > 0
  double not_negative(std::string_view key) const;  // >= 0
  static constexpr int greatest_count = 100000000;
  int count(std::string_view key, int most = greatest_count) const;                              // whole number > 0
  std::string text(std::string_view key, std::string_view expected = "a text in quotes") const;  // not empty
  Vec3 vec3(std::string_view key) const;                                                         // three finite numbers
  std::vector<int> integers(std::string_view key, int least = 0) const;
  Eigen::VectorXd numbers(std::string_view key, int count) const;  // so many finite numbers
  Points points(std::string_view key, int count) const;            // three numbers each, or so many triples

  TomlTable section(std::string_view key) const;                   // a table; an error when it is missing
  std::vector<TomlTable> sections(std::string_view key) const;     // an array of tables; empty when it is missing
  std::vector<TomlTable> one_or_more(std::string_view key) const;  // a table, or an array of tables

  /// Throws InputError at the line of the key: "FILE:LINE: KEY: expected EXPECTED".
  [[noreturn]] void fail(std::string_view key, const std::string& expected) const;
  /// Throws InputError when the file holds a key that was never read, here or in a section below.
  void finish() const;

 private:
  struct Node;
  explicit TomlTable(std::shared_ptr<Node> node);
  std::shared_ptr<Node> node_;
};

/// A TOML file that is changed key by key and written again (without its comments). A path is a dotted name:
/// "grid.stiffness.bend", "spring[2].stiffness".
class TomlDocument {
 public:
  /// Throws InputError when it is no TOML; name stands in for the file.
  TomlDocument(std::string_view text, const std::string& name);

  bool has(std::string_view path) const;
  /// Sets a value, new or not, in a table that is there. Throws InputError that names the path when it is not.
  void set(std::string_view path, double value);
  void set(std::string_view path, const std::string& value);
  void set(std::string_view path, const std::vector<int>& values);
  /// Takes the key out; nothing happens where there is none. "sphere[].friction" means that of every [[sphere]], and
  /// of [sphere].
  void erase(std::string_view path);
  /// Paths of all values that are this text, in the order of the keys.
  std::vector<std::string> where(std::string_view value) const;
  std::string text() const;

 private:
  struct Tree;
  std::shared_ptr<Tree> tree_;
};

// A diagnosis of text that is no TOML: which line to mend, and how.

/// A fault of the text: the line (from 1) that is to be mended, which need not be the one where a parser stumbles, and
/// how.
struct TomlError {
  int line;
  std::string what;
};

/// line and description: where the parser stumbled, and what it says, which is kept where nothing better is known.
TomlError diagnose_toml(std::string_view text, int line, std::string_view description);

/// The fault of a key with so many dots that toml++, which goes as deep for each, would exhaust the stack.
std::optional<TomlError> too_deep_key(std::string_view text);

}  // namespace crosscheck
