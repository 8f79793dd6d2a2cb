// JSON: values that are built and written, and files with look-ups that name file, place and what was expected. The one
// file that knows the library behind it is json.cpp.
#pragma once

#include <concepts>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace crosscheck {

/// A JSON value that is built and then written; objects keep the order in which their keys came. Numbers take no memory
/// of their own, so that long lists are cheap. A value that is no list, object or null where one is expected throws
/// std::logic_error: that is a bug, not a fault of a file.
class Json {
 public:
  struct Member;

  Json() : whole_(0) {}  // null
  Json(std::nullptr_t) : Json() {}
  template <std::integral T>  // bool is true or false, all others are numbers, char too
  Json(T value) : Json() {
    if constexpr (std::same_as<T, bool>)
      kind_ = Kind::boolean, boolean_ = value;
    else if constexpr (std::signed_integral<T>)
      kind_ = Kind::whole, whole_ = value;
    else
      kind_ = Kind::natural, natural_ = value;
  }
  Json(double value) : kind_(Kind::real), real_(value) {}  // what is not finite is written as null
  Json(std::string text);
  Json(std::string_view text) : Json(std::string(text)) {}
  Json(const char* text) : Json(std::string(text)) {}
  /// An object: {{"a", 1}, {"b", {{"c", "text"}}}}. There is no such short form of a list; see list().
  Json(std::initializer_list<Member> members);
  Json(std::span<const double> numbers) : Json(list()) { append(numbers); }
  Json(std::span<const int> numbers) : Json(list()) { append(numbers); }
  template <class T>
  Json(const std::vector<T>& items) : Json(list()) {
    append(items);
  }
  template <class T>  // none is null
  Json(const std::optional<T>& value) : Json(value ? Json(*value) : Json()) {}

  Json(const Json& other);
  Json(Json&& other) noexcept : Json() { swap(other); }
  Json& operator=(Json other) noexcept { return swap(other), *this; }
  ~Json();

  static Json object();                            // an empty one
  static Json list() { return Json(Kind::list); }  // an empty one
  template <class First, class... Rest>            // of these items
  static Json list(First&& first, Rest&&... rest) {
    Json items = list();
    items.push(Json(std::forward<First>(first)));
    (items.push(Json(std::forward<Rest>(rest))), ...);
    return items;
  }

  /// The value under the key of an object; a new key comes last, its value is null. Null becomes an object.
  Json& operator[](std::string_view key);
  /// Appends to a list and gives the item there. Null becomes a list.
  Json& push(Json item);
  void erase(std::string_view key);  // of an object; nothing happens where there is none
  void update(Json members);         // sets each member of another object
  bool is_null() const { return kind_ == Kind::null; }

  /// In one line, or with so many blanks of indentation. Bytes that are no UTF-8 are replaced by U+FFFD; numbers have
  /// as many digits as give the same bits when they are read.
  std::string dump(int indent = -1) const;
  /// Of an object: a line for each member.
  std::string dump_in_lines() const;

 private:
  friend class JsonField;
  struct Parts;  // what json.cpp alone knows of the insides
  enum class Kind : std::uint8_t { null, boolean, whole, natural, real, text, list, object };

  explicit Json(Kind kind);
  void swap(Json& other) noexcept;
  void reserve(size_t items);
  template <class Items>
  void append(const Items& items) {
    reserve(items.size());
    for (const auto& item : items) push(Json(item));
  }

  Kind kind_ = Kind::null;
  union {
    bool boolean_;
    std::int64_t whole_;
    std::uint64_t natural_;
    double real_;
    std::string* text_;
    std::vector<Json>* list_;
    std::vector<std::pair<std::string, Json>>* object_;
  };
};

struct Json::Member {
  std::string_view key;
  mutable Json value;  // moved out of the initialiser list, which itself can be read only
};

/// A value in a JSON file and where it stands; keeps what was read alive. Every look-up throws InputError
/// ("FILE: terms[2].law: expected ..., got ..."); where there is no such error the place costs nothing.
class JsonField {
 public:
  /// Of a text; name stands in for the file. Throws InputError with line and column of what is no JSON, or is nested
  /// more than 500 deep. Of keys that come twice the last counts.
  static JsonField parse(std::string_view text, std::string name);
  /// Of a file. Throws InputError also when it cannot be read, or is no object.
  static JsonField parse_file(const std::string& file);

  JsonField operator[](std::string_view key) const;              // of an object; an error when it is missing
  std::optional<JsonField> find(std::string_view key) const;     // none when it is missing or null
  JsonField operator[](size_t i) const;                          // of a list
  size_t size() const;                                           // of a list or an object
  std::vector<JsonField> elements() const;                       // of a list
  std::vector<std::pair<std::string, JsonField>> items() const;  // of an object, in its order

  bool is_null() const { return kind() == Json::Kind::null; }
  bool is_text() const { return kind() == Json::Kind::text; }
  bool is_boolean() const { return kind() == Json::Kind::boolean; }
  bool is_list() const { return kind() == Json::Kind::list; }
  bool is_object() const { return kind() == Json::Kind::object; }
  bool is_number() const { return is_integer() || kind() == Json::Kind::real; }
  bool is_integer() const {
    return kind() == Json::Kind::whole || kind() == Json::Kind::natural;
  }  // written without . and e

  double number() const;
  double number_from(double lowest) const;   // not below it
  int whole_number(int from, int to) const;  // both included
  long whole() const;
  std::uint64_t natural() const;  // a whole number not below zero
  bool boolean() const;
  std::string text() const;
  std::vector<double> numbers() const;
  std::vector<int> indices(int count) const;        // each from 0 to count - 1
  std::vector<double> triples(size_t count) const;  // 3 * count, of a list of count lists of three
  std::vector<std::string> texts() const;
  std::string dump(int indent = -1) const { return value_->dump(indent); }

  /// Throws InputError: "FILE: PLACE: expected EXPECTED, got what stands there".
  [[noreturn]] void fail(const std::string& expected) const;

 private:
  struct Document;
  JsonField(std::shared_ptr<const Document> document, const Json& value)
      : document_(std::move(document)), value_(&value) {}
  static JsonField parse(std::string_view text, std::string name, const char* expected);
  Json::Kind kind() const { return value_->kind_; }
  std::string place_of(const Json& value) const;  // "terms[2].law"; empty: all
  [[noreturn]] void fail_at(const Json& value, const std::string& expected) const;

  std::shared_ptr<const Document> document_;
  const Json* value_;
};

}  // namespace crosscheck
