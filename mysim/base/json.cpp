#include "mysim/base/json.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>

#include "mysim/base/errors.h"
#include "mysim/base/files.h"

namespace crosscheck {

struct JsonField::Document {
  Json root;
  std::string name;
};

std::string dump(const Json& json, int indent) { return json.dump(indent, ' ', false, Json::error_handler_t::replace); }

std::string dump_in_lines(const Json& object) {
  std::string text = "{";
  for (const auto& [key, value] : object.items())
    text += fmt::format("{}\n {}: {}", text.size() > 1 ? "," : "", dump(key), dump(value));
  return text + "\n}\n";
}

namespace {

/// Appends the path that leads from a value to another one inside it; returns false if it is not inside.
bool find_path(const Json& from, const Json& to, std::string& path) {
  if (&from == &to) return true;
  if (!from.is_structured()) return false;
  const size_t length = path.size();
  for (auto item = from.begin(); item != from.end(); ++item) {
    path += from.is_array() ? fmt::format("[{}]", item - from.begin()) : (path.empty() ? "" : ".") + item.key();
    if (find_path(*item, to, path)) return true;
    path.resize(length);
  }
  return false;
}

/// Callbacks for the library's parser. They replace the library's own tree builder, which has no depth limit and
/// compares each key with all keys before it.
class Reader {
 public:
  bool null() { return add(nullptr), true; }
  bool boolean(bool value) { return add(value), true; }
  bool number_integer(std::int64_t value) { return add(value), true; }
  bool number_unsigned(std::uint64_t value) { return add(value), true; }
  bool number_float(double value, const std::string&) { return add(value), true; }
  bool string(std::string& value) { return add(std::move(value)), true; }
  bool binary(Json::binary_t&) { return false; }  // never called for text
  bool start_array(size_t) { return open(Json::array()); }
  bool start_object(size_t) { return open(Json::object()); }
  bool key(std::string& name) { return members().emplace_back(std::move(name), nullptr), true; }
  bool end_array() { return open_.pop_back(), true; }
  bool end_object() {
    std::map<std::string_view, const Json*> last_of_key;
    for (const auto& [key, value] : members()) last_of_key[key] = &value;
    if (last_of_key.size() < members().size()) {
      Json::object_t kept;
      for (auto& [key, value] : members())
        if (last_of_key[key] == &value) kept.emplace_back(key, std::move(value));
      members() = std::move(kept);
    }
    return open_.pop_back(), true;
  }
  bool parse_error(size_t at, const std::string& token, const nlohmann::json::exception& error) {
    // keeps "invalid literal" of "[json.exception.parse_error.101] parse error at line 1, column 3: syntax error while
    // parsing value - invalid literal; last read: 'N'"
    wrong = error.what();
    for (const std::string_view before : {"] ", ": ", " - "})
      if (const size_t found = wrong.find(before); found != std::string::npos) wrong.erase(0, found + before.size());
    wrong.erase(std::min(wrong.find("; last read: "), wrong.size()));
    // wording of nlohmann-json before version 3.11.3
    if (wrong.starts_with("attempting to parse an empty input"))
      wrong = "unexpected end of input; expected '[', '{', or a literal";
    read = at;
    // matches nan, NaN, -inf, Infinity, 1.#INF
    not_finite = wrong.starts_with("number overflow") ||
                 ((wrong.starts_with("invalid literal") || wrong.starts_with("invalid number")) &&
                  token.find_first_of("nNiI#+") != std::string::npos);
    return false;
  }

  /// Path of the value at which parsing ended: "readback.links[3].stiffness".
  std::string path() const {
    std::string path;
    if (open_.empty()) return path;
    find_path(root, *open_.back(), path);
    if (open_.back()->is_array()) return path + fmt::format("[{}]", open_.back()->size());
    return members().empty() ? path : path + (path.empty() ? "" : ".") + members().back().first;
  }

  Json root;
  std::string wrong;
  size_t read = 0;          // bytes read, including the first wrong one
  bool not_finite = false;  // the wrong value is a non-finite number

 private:
  Json::object_t& members() const { return open_.back()->get_ref<Json::object_t&>(); }
  Json& add(Json value) {
    if (open_.empty()) return root = std::move(value);
    if (open_.back()->is_array()) return open_.back()->emplace_back(std::move(value));
    return members().back().second = std::move(value);
  }
  bool open(Json value) {
    constexpr size_t deepest = 500;
    if (open_.size() == deepest) wrong = fmt::format("nested more than {} levels deep", deepest);
    open_.push_back(&add(std::move(value)));
    return wrong.empty();
  }

  std::vector<Json*> open_;  // open lists and objects, innermost last
};

/// "line 2, column 7: invalid literal; steps: expected a finite number: ..."
std::string parse_error(std::string_view text, const Reader& reader) {
  if (reader.read == 0) return reader.wrong;
  const std::string_view before = text.substr(0, reader.read - 1);
  std::string why = fmt::format("line {}, column {}: {}", 1 + std::count(before.begin(), before.end(), '\n'),
                                before.size() - (before.rfind('\n') + 1) + 1, reader.wrong);  // npos + 1 is 0
  if (const std::string path = reader.not_finite ? reader.path() : ""; !path.empty())
    why += fmt::format("; {}: expected a finite number (JSON has no others); omit keys without one", path);
  return why;
}

}  // namespace

JsonField JsonField::parse(std::string_view text, std::string name, const char* expected) {
  Reader reader;
  if (!nlohmann::json::sax_parse(text.begin(), text.end(), &reader))
    throw InputError(fmt::format("{}: expected {}; {}", name, expected, parse_error(text, reader)));
  const auto document = std::make_shared<const Document>(Document{std::move(reader.root), std::move(name)});
  return {document, document->root};
}

JsonField JsonField::parse_file(const std::string& file) {
  const std::optional<std::string> text = try_read_file(file);
  if (!text) throw InputError(fmt::format("{}: cannot be read; expected a JSON file", file));
  const char* expected = "one JSON object";
  JsonField root = parse(*text, file, expected);
  if (!root.is_object()) root.fail(expected);
  return root;
}

std::string JsonField::place() const {
  std::string path;
  find_path(document_->root, *value_, path);
  return document_->name + ": " + (path.empty() ? "" : path + ": ");
}

void JsonField::fail(const std::string& expected) const {
  constexpr size_t longest = 60;
  const std::string* text = value_->get_ptr<const std::string*>();
  const std::string got = is_list()                        ? fmt::format("a list of {}", size())
                          : is_object()                    ? "an object"
                          : text && text->size() > longest ? crosscheck::dump(text->substr(0, longest)) + "..."
                                                           : dump();
  throw InputError(fmt::format("{}expected {}, got {}", place(), expected, got));
}

const Json& JsonField::list(const std::string& expected) const {
  if (!is_list()) fail(expected);
  return *value_;
}

const Json& JsonField::object() const {
  if (!is_object()) fail("an object");
  return *value_;
}

std::optional<JsonField> JsonField::find(std::string_view key) const {
  const auto member = object().find(key);
  if (member == value_->end() || member->is_null()) return std::nullopt;
  return JsonField(document_, *member);
}

JsonField JsonField::operator[](std::string_view key) const {
  const auto member = object().find(key);
  if (member == value_->end()) throw InputError(fmt::format("{}expected the key \"{}\"", place(), key));
  return {document_, *member};
}

JsonField JsonField::operator[](size_t i) const {
  if (!is_list() || i >= size()) fail(fmt::format("a list of {} or more", i + 1));
  return {document_, (*value_)[i]};
}

size_t JsonField::size() const {
  if (!value_->is_structured()) fail("a list or an object");
  return value_->size();
}

std::vector<JsonField> JsonField::elements() const {
  std::vector<JsonField> all;
  for (const Json& item : list("a list")) all.push_back({document_, item});
  return all;
}

std::vector<std::pair<std::string, JsonField>> JsonField::items() const {
  std::vector<std::pair<std::string, JsonField>> all;
  for (const auto& [key, value] : object().items()) all.emplace_back(key, JsonField(document_, value));
  return all;
}

bool JsonField::is_null() const { return value_->is_null(); }
bool JsonField::is_text() const { return value_->is_string(); }
bool JsonField::is_boolean() const { return value_->is_boolean(); }
bool JsonField::is_list() const { return value_->is_array(); }
bool JsonField::is_object() const { return value_->is_object(); }
bool JsonField::is_number() const { return value_->is_number(); }
bool JsonField::is_integer() const { return value_->is_number_integer(); }

double JsonField::number() const {
  if (!is_number()) fail("a number");
  return value_->get<double>();
}

double JsonField::number_from(double lowest) const {
  const double value = number();
  if (!(value >= lowest)) fail(fmt::format("a number not below {:g}", lowest));
  return value;
}

namespace {

/// The integer, if it is within the range of int64.
std::optional<std::int64_t> whole_of(const Json& value) {
  if (!value.is_number_integer() || (value.is_number_unsigned() && value.get<std::uint64_t>() > INT64_MAX))
    return std::nullopt;
  return value.get<std::int64_t>();
}

}  // namespace

int JsonField::whole_number(int from, int to) const {
  const auto value = whole_of(*value_);
  if (!value || *value < from || *value > to) fail(fmt::format("a whole number from {} to {}", from, to));
  return static_cast<int>(*value);
}

long JsonField::whole() const {
  const auto value = whole_of(*value_);
  if (!value) fail("a whole number below 2^63");
  return *value;
}

std::uint64_t JsonField::natural() const {
  if (!value_->is_number_unsigned()) fail("a whole number not below 0");
  return value_->get<std::uint64_t>();
}

bool JsonField::boolean() const {
  if (!is_boolean()) fail("true or false");
  return value_->get<bool>();
}

std::string JsonField::text() const {
  if (!is_text()) fail("a text");
  return value_->get<std::string>();
}

std::vector<double> JsonField::numbers() const {
  std::vector<double> all;
  all.reserve(list("a list of numbers").size());
  for (const Json& item : *value_) all.push_back(JsonField(document_, item).number());
  return all;
}

std::vector<int> JsonField::indices(int count) const {
  std::vector<int> all;
  for (const JsonField& element : elements()) all.push_back(element.whole_number(0, count - 1));
  return all;
}

std::vector<double> JsonField::triples(size_t count) const {
  if (!is_list() || size() != count) fail(fmt::format("{} triples of numbers", count));
  std::vector<double> all;
  all.reserve(3 * count);
  for (const Json& item : *value_) {
    const JsonField triple(document_, item);
    if (!triple.is_list() || triple.size() != 3) triple.fail("three numbers");
    for (const Json& number : item) all.push_back(JsonField(document_, number).number());
  }
  return all;
}

std::vector<std::string> JsonField::texts() const {
  std::vector<std::string> all;
  for (const JsonField& element : elements()) all.push_back(element.text());
  return all;
}

std::string JsonField::dump(int indent) const { return crosscheck::dump(*value_, indent); }

}  // namespace crosscheck
