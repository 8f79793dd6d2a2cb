// JSON: documents to build and write; parsed files, whose look-ups report file, path and expected value in errors.
#pragma once

#include <cstdint>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace crosscheck {

/// A JSON value to build and write; keeps the order of keys. Source files that build one include <nlohmann/json.hpp>.
/// Write it with dump() below: the member function dump() throws on invalid UTF-8.
using Json = nlohmann::ordered_json;

/// The text on one line, or indented by `indent` blanks. Writes U+FFFD for invalid UTF-8, null for non-finite numbers,
/// and other numbers with all digits needed to restore their bits.
std::string dump(const Json& json, int indent = -1);
/// The text of an object, one line per member.
std::string dump_in_lines(const Json& object);

/// A value in a JSON file with its location; keeps the document alive. All look-ups throw InputError ("FILE:
/// terms[2].law: expected ..., got ..."). The path is determined only for errors.
class JsonField {
 public:
  /// Parses a text; `name` stands for the file in messages. Throws InputError with line and column for invalid JSON,
  /// and for documents nested more than 500 levels deep. If a key is repeated, its last value counts.
  static JsonField parse(std::string_view text, std::string name, const char* expected = "JSON");
  /// Parses a file. Also throws InputError if the file cannot be read or is not one object.
  static JsonField parse_file(const std::string& file);

  JsonField operator[](std::string_view key) const;
  std::optional<JsonField> find(std::string_view key) const;  // nothing if the key is missing or its value is null
  JsonField operator[](size_t i) const;
  size_t size() const;                                           // length of a list or object
  std::vector<JsonField> elements() const;                       // elements of a list
  std::vector<std::pair<std::string, JsonField>> items() const;  // members of an object, in their order

  bool is_null() const;
  bool is_text() const;
  bool is_boolean() const;
  bool is_list() const;
  bool is_object() const;
  bool is_number() const;
  bool is_integer() const;  // written without '.' and exponent

  double number() const;
  double number_from(double lowest) const;
  int whole_number(int from, int to) const;  // both inclusive
  long whole() const;
  std::uint64_t natural() const;
  bool boolean() const;
  std::string text() const;
  std::vector<double> numbers() const;
  std::vector<int> indices(int count) const;        // each from 0 to count - 1
  std::vector<double> triples(size_t count) const;  // 3 * count numbers, from count lists of three
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
