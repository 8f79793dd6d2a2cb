// Readers of the formats' output: JSON against a table of fields, and a subset of XML.
#pragma once

#include <fmt/format.h>

#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "mysim/base/json.h"

namespace coursework::testing_tools {

struct Field {
  std::string name;
  enum Type { number, text, flag, object, list, any } type;
  bool required = true;
  std::vector<std::string> allowed = {};  // allowed text values; if empty, any text is allowed
};

inline bool is(const crosscheck::JsonField& value, Field::Type type) {
  switch (type) {
    case Field::number:
      return value.is_number();
    case Field::text:
      return value.is_text();
    case Field::flag:
      return value.is_boolean();
    case Field::object:
      return value.is_object();
    case Field::list:
      return value.is_list();
    case Field::any:
      return true;
  }
  return false;
}

/// Violations of the schema, one per line.
inline std::string violations(const crosscheck::JsonField& value, const std::vector<Field>& fields,
                              const std::string& where) {
  if (!value.is_object()) return where + " is no object\n";
  std::string wrong;
  for (const Field& field : fields) {
    const auto found = value.find(field.name);
    if (!found) {
      if (field.required) wrong += fmt::format("{}.{} is missing\n", where, field.name);
    } else if (!is(*found, field.type)) {
      wrong += fmt::format("{}.{} has the wrong type\n", where, field.name);
    } else if (!field.allowed.empty()) {
      bool good = false;
      for (const std::string& value_of : field.allowed) good |= found->is_text() && found->text() == value_of;
      if (!good) wrong += fmt::format("{}.{} is {}\n", where, field.name, found->dump());
    }
  }
  for (const auto& [key, unused] : value.items()) {
    bool known = false;
    for (const Field& field : fields) known |= field.name == key;
    if (!known) wrong += fmt::format("{}.{} is not documented\n", where, key);
  }
  return wrong;
}

// A subset of XML: elements, attributes, text, the five named entities and decimal entities.

struct Element {
  std::string name, text;
  std::map<std::string, std::string> attributes;
  std::vector<Element> children;
};

/// Throws std::runtime_error if the text is not well formed.
class XmlReader {
 public:
  explicit XmlReader(const std::string& text) : text_(text) {}
  Element document() {
    if (taken("<?xml")) at_ = text_.find("?>", at_) + 2;
    blanks();
    const Element root = element();
    blanks();
    need(at_ == text_.size(), "something after the root");
    return root;
  }

 private:
  static bool of_name(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_' || c == ':';
  }
  void need(bool good, const std::string& what) const {
    if (!good) throw std::runtime_error(what + " at " + std::to_string(at_));
  }
  char here() const {
    need(at_ < text_.size(), "end of text");
    return text_[at_];
  }
  bool taken(const std::string& what) {
    if (text_.compare(at_, what.size(), what) != 0) return false;
    at_ += what.size();
    return true;
  }
  void blanks() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
  }
  std::string name() {
    std::string out;
    while (of_name(here())) out += text_[at_++];
    need(!out.empty(), "no name");
    return out;
  }
  std::string until(char end) {
    std::string out;
    for (; here() != end; ++at_) {
      const unsigned char c = static_cast<unsigned char>(here());
      need(c != '<' && (c >= 0x20 || c == '\n' || c == '\t'), "character that may not stand there");
      if (c != '&') {
        out += here();
        continue;
      }
      const size_t stop = text_.find(';', at_);
      const std::string entity = text_.substr(at_ + 1, stop - at_ - 1);
      static const std::map<std::string, char> named = {
          {"amp", '&'}, {"lt", '<'}, {"gt", '>'}, {"quot", '"'}, {"apos", '\''}};
      need(stop != std::string::npos && (named.count(entity) || entity[0] == '#'), "unknown entity " + entity);
      out += named.count(entity) ? named.at(entity) : static_cast<char>(std::stoi(entity.substr(1)));
      at_ = stop;
    }
    return out;
  }
  Element element() {
    need(taken("<"), "no element");
    Element e;
    e.name = name();
    for (blanks(); of_name(here()); blanks()) {
      const std::string key = name();
      need(taken("=\""), "no value");
      need(e.attributes.emplace(key, until('"')).second, "attribute twice");
      ++at_;
    }
    if (taken("/>")) return e;
    need(taken(">"), "no end of the tag");
    while (!taken("</")) here() == '<' ? e.children.push_back(element()) : void(e.text += until('<'));
    need(taken(e.name) && taken(">"), "wrong end of " + e.name);
    return e;
  }

  const std::string& text_;
  size_t at_ = 0;
};

}  // namespace coursework::testing_tools
