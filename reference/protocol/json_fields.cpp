// Look-ups that fail with one line.
#include "reference/protocol/json_fields.h"

#include <fmt/format.h>

#include <fstream>

#include "mysim/errors.h"

namespace crosscheck {

nlohmann::json JsonField::parse_file(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw InputError(fmt::format("{}: cannot be read; expected a JSON file", file));
  nlohmann::json json = nlohmann::json::parse(in, nullptr, false);
  if (!json.is_object()) throw InputError(fmt::format("{}: expected one JSON object", file));
  return json;
}

void JsonField::fail(const std::string& expected) const {
  throw InputError(fmt::format("{}: {}{}expected {}", file_, place_, place_.empty() ? "" : ": ", expected));
}

JsonField JsonField::operator[](std::string_view key) const {
  if (const auto found = find(key)) return *found;
  fail(fmt::format("the key \"{}\"", key));
}

std::optional<JsonField> JsonField::find(std::string_view key) const {
  if (!value_.is_object()) fail("an object");
  const auto at = value_.find(key);
  if (at == value_.end() || at->is_null()) return std::nullopt;
  return JsonField(*at, file_, fmt::format("{}{}{}", place_, place_.empty() ? "" : ".", key));
}

std::vector<JsonField> JsonField::elements() const {
  if (!value_.is_array()) fail("a list");
  std::vector<JsonField> list;
  for (size_t i = 0; i < value_.size(); ++i) list.emplace_back(value_[i], file_, fmt::format("{}[{}]", place_, i));
  return list;
}

std::vector<std::pair<std::string, JsonField>> JsonField::items() const {
  if (!value_.is_object()) fail("an object");
  std::vector<std::pair<std::string, JsonField>> list;
  for (const auto& item : value_.items()) list.emplace_back(item.key(), *find(item.key()));
  return list;
}

double JsonField::number() const {
  if (!value_.is_number()) fail("a number");
  return value_.get<double>();
}

double JsonField::number_from(double lowest) const {
  const double value = number();
  if (!(value >= lowest)) fail(fmt::format("a number not below {:g}", lowest));
  return value;
}

int JsonField::whole_number(int from, int to) const {
  if (value_.is_number_integer())
    if (const auto value = value_.get<std::int64_t>(); value >= from && value <= to) return static_cast<int>(value);
  fail(fmt::format("a whole number from {} to {}", from, to));
}

bool JsonField::truth() const {
  if (!value_.is_boolean()) fail("true or false");
  return value_.get<bool>();
}

std::string JsonField::text() const {
  if (!value_.is_string()) fail("a text");
  return value_.get<std::string>();
}

Vec3 JsonField::vec3() const {
  const std::vector<double> parts = numbers();
  if (parts.size() != 3) fail("three numbers");
  return {parts[0], parts[1], parts[2]};
}

std::vector<double> JsonField::numbers() const {
  if (!value_.is_array()) fail("a list of numbers");
  std::vector<double> list;
  for (const auto& value : value_) {
    if (!value.is_number()) fail("a list of numbers");
    list.push_back(value.get<double>());
  }
  return list;
}

std::vector<int> JsonField::indices(int count) const {
  std::vector<int> list;
  for (const JsonField& element : elements()) list.push_back(element.whole_number(0, count - 1));
  return list;
}

Points JsonField::points(int count) const {
  if (!value_.is_array() || static_cast<int>(value_.size()) != count) fail(fmt::format("{} triples of numbers", count));
  Points p(3, count);
  int i = 0;
  for (const JsonField& element : elements()) p.col(i++) = element.vec3();
  return p;
}

std::vector<std::string> JsonField::texts() const {
  std::vector<std::string> list;
  for (const JsonField& element : elements()) list.push_back(element.text());
  return list;
}

nlohmann::ordered_json json_of(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

nlohmann::ordered_json json_of(const Points& p) {
  auto list = nlohmann::ordered_json::array();
  for (int i = 0; i < p.cols(); ++i) list.push_back(json_of(Vec3(p.col(i))));
  return list;
}

}  // namespace crosscheck
