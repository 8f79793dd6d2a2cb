// JSON: documents that are built and written, and files with look-ups that name file, place and what was expected.
#pragma once

#include <cstdint>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace crosscheck {

/// A value that is built and written; objects keep the order of their keys. Files that build one include
/// <nlohmann/json.hpp>. Write it with dump() below: the member of that name throws on invalid UTF-8.
using Json = nlohmann::ordered_json;

/// The text on one line, or indented by that many blanks. Replaces invalid UTF-8 by U+FFFD and non-finite numbers by
/// null; other numbers have as many digits as restore their bits.
std::string dump(const Json& json, int indent = -1);
/// An object with one line for each member.
std::string dump_in_lines(const Json& object);

/// A value in a JSON file and its place there; keeps the document alive. Every look-up throws InputError
/// ("FILE: terms[2].law: expected ..., got ..."). The place is searched for only when there is an error.
class JsonField {
 public:
  /// Parses a text; `name` stands for the file in messages. Throws InputError with line and column for invalid JSON and
  /// for documents nested more than 500 deep. The last of equal keys counts.
  static JsonField parse(std::string_view text, std::string name, const char* expected = "JSON");
  /// Parses a file. Also throws InputError if the file cannot be read or is not one object.
  static JsonField parse_file(const std::string& file);

  JsonField operator[](std::string_view key) const;              // throws InputError if the key is missing
  std::optional<JsonField> find(std::string_view key) const;     // nothing if the key is missing or its value null
  JsonField operator[](size_t i) const;                          // item of a list
  size_t size() const;                                           // of a list or an object
  std::vector<JsonField> elements() const;                       // of a list
  std::vector<std::pair<std::string, JsonField>> items() const;  // of an object, in its order

  bool is_null() const;
  bool is_text() const;
  bool is_boolean() const;
  bool is_list() const;
  bool is_object() const;
  bool is_number() const;
  bool is_integer() const;  // written without '.' and exponent

  double number() const;
  double number_from(double lowest) const;
  int whole_number(int from, int to) const;  // both included
  long whole() const;
  std::uint64_t natural() const;
  bool boolean() const;
  std::string text() const;
  std::vector<double> numbers() const;
  std::vector<int> indices(int count) const;        // each from 0 to count - 1
  std::vector<double> triples(size_t count) const;  // 3 * count numbers, from a list of count lists of three
  std::vector<std::string> texts() const;
  std::string dump(int indent = -1) const;
  const Json& json() const { return *value_; }

  /// Throws InputError: "FILE: PLACE: expected EXPECTED, got VALUE".
  [[noreturn]] void fail(const std::string& expected) const;

 private:
  struct Document;
  JsonField(std::shared_ptr<const Document> document, const Json& value)
      : document_(std::move(document)), value_(&value) {}
  const Json& list(const std::string& expected) const;
  const Json& object() const;
  std::string place() const;  // "FILE: terms[2].law: "

  std::shared_ptr<const Document> document_;
  const Json* value_;
};

}  // namespace crosscheck
