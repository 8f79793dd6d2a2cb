// Typed look-ups in a JSON file that name file, place and what was expected when they fail.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mysim/types.h"

namespace crosscheck {

/// A value in a JSON file and where it stands. Every look-up throws InputError ("FILE: terms[2].law: expected ...").
class JsonField {
 public:
  JsonField(const nlohmann::json& value, std::string file, std::string place = "")
      : value_(value), file_(std::move(file)), place_(std::move(place)) {}
  /// Parses a file. Throws InputError when it cannot be read or is no JSON object.
  static nlohmann::json parse_file(const std::string& file);

  JsonField operator[](std::string_view key) const;              // of an object; an error when it is missing
  std::optional<JsonField> find(std::string_view key) const;     // none when it is missing or null
  std::vector<JsonField> elements() const;                       // of an array
  std::vector<std::pair<std::string, JsonField>> items() const;  // of an object

  double number() const;
  double number_from(double lowest) const;   // not below it
  int whole_number(int from, int to) const;  // both included
  bool truth() const;
  std::string text() const;
  Vec3 vec3() const;
  std::vector<double> numbers() const;
  std::vector<int> indices(int count) const;  // each from 0 to count - 1
  Points points(int count) const;             // 3 x count, from count triples
  std::vector<std::string> texts() const;

  [[noreturn]] void fail(const std::string& expected) const;

 private:
  const nlohmann::json& value_;
  std::string file_, place_;
};

/// Three numbers, and one triple for each column.
nlohmann::ordered_json json_of(const Vec3& v);
nlohmann::ordered_json json_of(const Points& p);

}  // namespace crosscheck
