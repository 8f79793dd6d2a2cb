// A tree of Crosscheck's own; nlohmann's library reads text into it and writes it out.
#include "mysim/base/json.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <numeric>

#include "mysim/base/errors.h"
#include "mysim/base/files.h"

namespace crosscheck {

using Written = nlohmann::ordered_json;
using Members = std::vector<std::pair<std::string, Json>>;

Json::Json(Kind kind) : Json() {
  if (kind == Kind::list)
    list_ = new std::vector<Json>;
  else
    object_ = new Members;
  kind_ = kind;
}

Json::Json(std::string text) : Json() {
  text_ = new std::string(std::move(text));
  kind_ = Kind::text;
}

Json::Json(std::initializer_list<Member> members) : Json(Kind::object) {
  object_->reserve(members.size());
  for (const Member& member : members) object_->emplace_back(member.key, std::move(member.value));
}

Json::Json(const Json& other) : Json() {
  if (other.kind_ == Kind::text)
    text_ = new std::string(*other.text_);
  else if (other.kind_ == Kind::list)
    list_ = new std::vector<Json>(*other.list_);
  else if (other.kind_ == Kind::object)
    object_ = new Members(*other.object_);
  else
    natural_ = other.natural_;  // the bits of any number
  kind_ = other.kind_;
}

Json::~Json() {
  if (kind_ == Kind::text) delete text_;
  if (kind_ == Kind::list) delete list_;
  if (kind_ == Kind::object) delete object_;
}

void Json::swap(Json& other) noexcept {
  std::swap(kind_, other.kind_);
  std::swap(natural_, other.natural_);
}

Json Json::object() { return Json(Kind::object); }

/// The insides, for this file alone.
struct Json::Parts {
  static Json& make(Json& json, Kind kind, const char* what) {
    if (json.is_null()) json = Json(kind);
    if (json.kind_ != kind) throw std::logic_error(fmt::format("{} is asked of the JSON {}", what, json.dump()));
    return json;
  }
  static const Json* member(const Json& object, std::string_view key) {
    for (const auto& [name, value] : *object.object_)
      if (name == key) return &value;
    return nullptr;
  }
  static Members& members(Json& json) { return *make(json, Kind::object, "a key").object_; }
  static std::vector<Json>& items(Json& json) { return *make(json, Kind::list, "an item").list_; }
  static std::optional<double> number(const Json& json) {
    if (json.kind_ == Kind::real) return json.real_;
    if (json.kind_ == Kind::whole) return static_cast<double>(json.whole_);
    if (json.kind_ == Kind::natural) return static_cast<double>(json.natural_);
    return std::nullopt;
  }

  /// Writes through the library.
  static Written written(const Json& json) {
    switch (json.kind_) {
      case Kind::null:
        return nullptr;
      case Kind::boolean:
        return json.boolean_;
      case Kind::whole:
        return json.whole_;
      case Kind::natural:
        return json.natural_;
      case Kind::real:
        return json.real_;
      case Kind::text:
        return *json.text_;
      case Kind::list: {
        Written::array_t list;
        list.reserve(json.list_->size());
        for (const Json& item : *json.list_) list.push_back(written(item));
        return list;
      }
      case Kind::object:
        break;
    }
    Written object = Written::object();
    // as the keys differ already, none is looked for
    std::vector<std::pair<const std::string, Written>>& members = object.get_ref<Written::object_t&>();
    members.reserve(json.object_->size());
    for (const auto& [key, value] : *json.object_) members.emplace_back(key, written(value));
    return object;
  }

  /// A few words that say what it is.
  static std::string in_words(const Json& json) {
    if (json.kind_ == Kind::list) return fmt::format("a list of {}", json.list_->size());
    if (json.kind_ == Kind::object) return "an object";
    constexpr size_t longest = 60;
    return json.kind_ == Kind::text && json.text_->size() > longest
               ? Json(json.text_->substr(0, longest)).dump() + "..."
               : json.dump();
  }

  /// Appends the path from a value to one inside of it; false: it is not inside.
  static bool find_path(const Json& from, const Json& to, std::string& place) {
    if (&from == &to) return true;
    const size_t length = place.size();
    if (from.kind_ == Kind::list)
      for (size_t i = 0; i < from.list_->size(); ++i) {
        place += fmt::format("[{}]", i);
        if (find_path((*from.list_)[i], to, place)) return true;
        place.resize(length);
      }
    if (from.kind_ == Kind::object)
      for (const auto& [key, value] : *from.object_) {
        place += (place.empty() ? "" : ".") + key;
        if (find_path(value, to, place)) return true;
        place.resize(length);
      }
    return false;
  }

  /// Callbacks of the library while it reads.
  class Reader {
   public:
    bool null() { return add(Json()), true; }
    bool boolean(bool value) { return add(value), true; }
    bool number_integer(std::int64_t value) { return add(value), true; }
    bool number_unsigned(std::uint64_t value) { return add(value), true; }
    bool number_float(double value, const std::string&) { return add(value), true; }
    bool string(std::string& value) { return add(std::move(value)), true; }
    bool binary(std::vector<std::uint8_t>&) { return false; }  // not of text
    bool start_array(size_t) { return open(Json::list()); }
    bool start_object(size_t) { return open(Json::object()); }
    bool key(std::string& name) { return open_.back()->object_->emplace_back(std::move(name), Json()), true; }
    bool end_array() { return open_.pop_back(), true; }
    bool end_object() {
      keep_last_of_each_key(*open_.back()->object_);
      return open_.pop_back(), true;
    }
    bool parse_error(size_t at, const std::string& token, const nlohmann::json::exception& error) {
      // "[json.exception.parse_error.101] parse error at line 1, column 3: syntax error while parsing value - invalid
      // literal; last read: 'N'": the words behind the dash
      wrong = error.what();
      for (const std::string_view before : {"] ", ": ", " - "})
        if (const size_t found = wrong.find(before); found != std::string::npos) wrong.erase(0, found + before.size());
      wrong.erase(std::min(wrong.find("; last read: "), wrong.size()));
      // as nlohmann-json before version 3.11.3 calls it
      if (wrong.starts_with("attempting to parse an empty input"))
        wrong = "unexpected end of input; expected '[', '{', or a literal";
      read = at;
      last = token.size();
      return false;
    }

    /// The place that was read when it ended: "readback.links[3].stiffness".
    std::string place() const {
      std::string path;
      if (open_.empty()) return path;
      const Json& parent = *open_.back();
      find_path(root, parent, path);
      if (parent.kind_ == Kind::list) return path + fmt::format("[{}]", parent.list_->size());
      if (!parent.object_->empty()) path += (path.empty() ? "" : ".") + parent.object_->back().first;
      return path;
    }

    Json root;
    std::string wrong;           // why it is no JSON
    std::optional<size_t> read;  // bytes, up to the first that are none
    size_t last = 0;             // bytes of the last word; only of a text does the library count them right

   private:
    Json& add(Json value) {
      if (open_.empty()) return root = std::move(value);
      Json& parent = *open_.back();
      if (parent.kind_ == Kind::list) return parent.list_->emplace_back(std::move(value));
      return parent.object_->back().second = std::move(value);
    }
    bool open(Json value) {
      constexpr size_t deepest = 500;
      if (open_.size() == deepest) wrong = fmt::format("nested more than {} deep", deepest);
      open_.push_back(&add(std::move(value)));
      return wrong.empty();
    }
    static bool all_differ(const Members& members) {
      for (size_t i = 0; i < members.size(); ++i)
        for (size_t j = 0; j < i; ++j)
          if (members[i].first == members[j].first) return false;
      return true;
    }
    static void keep_last_of_each_key(Members& members) {
      if (members.size() <= 16 && all_differ(members)) return;  // nearly every object
      std::vector<size_t> order(members.size());
      std::iota(order.begin(), order.end(), size_t(0));
      const auto name = [&](size_t i) -> const std::string& { return members[i].first; };
      const auto by_name = [&](size_t a, size_t b) { return name(a) < name(b); };
      std::stable_sort(order.begin(), order.end(), by_name);
      std::vector<char> replaced(members.size());
      for (size_t i = 1; i < order.size(); ++i) replaced[order[i - 1]] = name(order[i - 1]) == name(order[i]);
      size_t kept = 0;
      for (size_t i = 0; i < members.size(); ++i)
        if (!replaced[i]) {
          if (kept != i) members[kept] = std::move(members[i]);
          ++kept;
        }
      members.resize(kept);
    }

    std::vector<Json*> open_;  // the list or object that is read, and those around it
  };
};

Json& Json::operator[](std::string_view key) {
  Members& members = Parts::members(*this);
  const auto at = std::find_if(members.begin(), members.end(), [&](const auto& member) { return member.first == key; });
  return at != members.end() ? at->second : members.emplace_back(key, Json()).second;
}

Json& Json::push(Json item) { return Parts::items(*this).emplace_back(std::move(item)); }

void Json::reserve(size_t items) { Parts::items(*this).reserve(items); }

void Json::erase(std::string_view key) {
  std::erase_if(Parts::members(*this), [&](const auto& member) { return member.first == key; });
}

void Json::update(Json members) {
  for (auto& [key, value] : Parts::members(members)) (*this)[key] = std::move(value);
}

std::string Json::dump(int indent) const {
  return Parts::written(*this).dump(indent, ' ', false, Written::error_handler_t::replace);
}

std::string Json::dump_in_lines() const {
  std::string text = "{";
  for (const auto& [key, value] : *object_)
    text += fmt::format("{}\n {}: {}", text.size() > 1 ? "," : "", Json(key).dump(), value.dump());
  return text + "\n}\n";
}

struct JsonField::Document {
  Json root;
  std::string name;
};

namespace {

/// Whether a word begins as programs write numbers that are not finite, which JSON has not.
bool starts_with_non_finite(std::string_view text) {
  if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
  std::string word(text.substr(0, 3));
  for (char& c : word) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return word == "nan" || word == "inf" || text.starts_with("1.#");
}

/// Where the word begins that ends what was read, with so many bytes where it is a text.
size_t begin_of_word(std::string_view text, size_t read, size_t length_of_text, const std::string& wrong) {
  size_t at = read > 0 ? read - 1 : 0;
  if (at >= text.size()) return text.size();
  if (text[at] == '"' || wrong.starts_with("invalid string")) return read - std::min(read, length_of_text);
  const auto in_word = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '+' || c == '.';
  };
  if (in_word(text[at]) || wrong.starts_with("invalid"))
    while (at > 0 && in_word(text[at - 1])) --at;
  return at;
}

}  // namespace

JsonField JsonField::parse(std::string_view text, std::string name, const char* expected) {
  Json::Parts::Reader reader;
  if (nlohmann::json::sax_parse(text.begin(), text.end(), &reader)) {
    const auto document = std::make_shared<const Document>(Document{std::move(reader.root), std::move(name)});
    return {document, document->root};
  }
  std::string why = reader.wrong;
  if (reader.read) {
    const size_t at = begin_of_word(text, *reader.read, reader.last, reader.wrong);
    const std::string_view before = text.substr(0, at);
    const size_t line = before.rfind('\n') + 1;  // npos + 1 is 0
    why = fmt::format("line {}, column {}: {}", 1 + std::count(before.begin(), before.end(), '\n'), at - line + 1, why);
    std::string_view rest = text.substr(at);
    const bool beyond_all = reader.wrong.starts_with("number overflow");
    const std::string place = beyond_all || starts_with_non_finite(rest) ? reader.place() : "";
    rest = rest.substr(0, std::min<size_t>(rest.find_first_of("\r\n"), 20));
    if (!rest.empty()) why += ", " + Json(rest).dump();
    if (!place.empty())
      why += fmt::format("; {}: expected a finite number: JSON has no other, leave out a key that has none", place);
  }
  throw InputError(fmt::format("{}: expected {}; {}", name, expected, why));
}

JsonField JsonField::parse(std::string_view text, std::string name) { return parse(text, std::move(name), "JSON"); }

JsonField JsonField::parse_file(const std::string& file) {
  const std::optional<std::string> text = try_read_file(file);
  if (!text) throw InputError(fmt::format("{}: cannot be read; expected a JSON file", file));
  const char* expected = "one JSON object";
  JsonField root = parse(*text, file, expected);
  if (!root.is_object()) root.fail(expected);
  return root;
}

std::string JsonField::place_of(const Json& value) const {
  std::string place;
  Json::Parts::find_path(document_->root, value, place);
  return place;
}

void JsonField::fail_at(const Json& value, const std::string& expected) const {
  const std::string place = place_of(value);
  throw InputError(fmt::format("{}: {}{}expected {}, got {}", document_->name, place, place.empty() ? "" : ": ",
                               expected, Json::Parts::in_words(value)));
}

void JsonField::fail(const std::string& expected) const { fail_at(*value_, expected); }

std::optional<JsonField> JsonField::find(std::string_view key) const {
  if (kind() != Json::Kind::object) fail("an object");
  const Json* member = Json::Parts::member(*value_, key);
  return member && !member->is_null() ? std::optional(JsonField(document_, *member)) : std::nullopt;
}

JsonField JsonField::operator[](std::string_view key) const {
  if (kind() != Json::Kind::object) fail("an object");
  if (const Json* member = Json::Parts::member(*value_, key)) return {document_, *member};
  const std::string place = place_of(*value_);
  throw InputError(
      fmt::format("{}: {}{}expected the key \"{}\"", document_->name, place, place.empty() ? "" : ": ", key));
}

JsonField JsonField::operator[](size_t i) const {
  if (kind() != Json::Kind::list || i >= value_->list_->size()) fail(fmt::format("a list of {} or more", i + 1));
  return {document_, (*value_->list_)[i]};
}

size_t JsonField::size() const {
  if (kind() == Json::Kind::object) return value_->object_->size();
  if (kind() != Json::Kind::list) fail("a list or an object");
  return value_->list_->size();
}

std::vector<JsonField> JsonField::elements() const {
  if (kind() != Json::Kind::list) fail("a list");
  std::vector<JsonField> list;
  list.reserve(value_->list_->size());
  for (const Json& item : *value_->list_) list.push_back({document_, item});
  return list;
}

std::vector<std::pair<std::string, JsonField>> JsonField::items() const {
  if (kind() != Json::Kind::object) fail("an object");
  std::vector<std::pair<std::string, JsonField>> list;
  list.reserve(value_->object_->size());
  for (const auto& [key, value] : *value_->object_) list.emplace_back(key, JsonField(document_, value));
  return list;
}

double JsonField::number() const {
  const auto value = Json::Parts::number(*value_);
  if (!value) fail("a number");
  return *value;
}

double JsonField::number_from(double lowest) const {
  const double value = number();
  if (!(value >= lowest)) fail(fmt::format("a number not below {:g}", lowest));
  return value;
}

int JsonField::whole_number(int from, int to) const {
  const bool inside = kind() == Json::Kind::natural ? value_->natural_ <= static_cast<std::uint64_t>(std::max(to, 0))
                                                    : kind() == Json::Kind::whole;
  if (inside)
    if (const std::int64_t value = whole(); value >= from && value <= to) return static_cast<int>(value);
  fail(fmt::format("a whole number from {} to {}", from, to));
}

long JsonField::whole() const {
  const bool inside =
      kind() == Json::Kind::natural ? value_->natural_ <= std::uint64_t(INT64_MAX) : kind() == Json::Kind::whole;
  if (!inside) fail("a whole number below 2^63");
  return value_->whole_;  // the same bits
}

std::uint64_t JsonField::natural() const {
  if (kind() != Json::Kind::natural && !(kind() == Json::Kind::whole && value_->whole_ >= 0))
    fail("a whole number not below 0");
  return value_->natural_;
}

bool JsonField::boolean() const {
  if (kind() != Json::Kind::boolean) fail("true or false");
  return value_->boolean_;
}

std::string JsonField::text() const {
  if (kind() != Json::Kind::text) fail("a text");
  return *value_->text_;
}

std::vector<double> JsonField::numbers() const {
  if (kind() != Json::Kind::list) fail("a list of numbers");
  std::vector<double> list;
  list.reserve(value_->list_->size());
  for (const Json& item : *value_->list_) {
    const auto value = Json::Parts::number(item);
    if (!value) fail_at(item, "a number");
    list.push_back(*value);
  }
  return list;
}

std::vector<int> JsonField::indices(int count) const {
  std::vector<int> list;
  for (const JsonField& element : elements()) list.push_back(element.whole_number(0, count - 1));
  return list;
}

std::vector<double> JsonField::triples(size_t count) const {
  if (kind() != Json::Kind::list || value_->list_->size() != count) fail(fmt::format("{} triples of numbers", count));
  std::vector<double> list;
  list.reserve(3 * count);
  for (const Json& triple : *value_->list_) {
    if (triple.kind_ != Json::Kind::list || triple.list_->size() != 3) fail_at(triple, "three numbers");
    for (const Json& item : *triple.list_) {
      const auto value = Json::Parts::number(item);
      if (!value) fail_at(item, "a number");
      list.push_back(*value);
    }
  }
  return list;
}

std::vector<std::string> JsonField::texts() const {
  std::vector<std::string> list;
  for (const JsonField& element : elements()) list.push_back(element.text());
  return list;
}

}  // namespace crosscheck
