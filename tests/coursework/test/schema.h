// A small checker of JSON against a table of fields: required ones, types, allowed values, and nothing else.
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "mysim/json.h"

namespace coursework::testing_tools {

struct Field {
  std::string name;
  enum Type { number, text, flag, object, list, any } type;
  bool required = true;
  std::vector<std::string> allowed = {};  // values of a text; empty: every one
};

inline bool is(const crosscheck::JsonField& value, Field::Type type) {
  switch (type) {
    case Field::number:
      return value.is_number();
    case Field::text:
      return value.is_text();
    case Field::flag:
      return value.is_truth();
    case Field::object:
      return value.is_object();
    case Field::list:
      return value.is_list();
    case Field::any:
      return true;
  }
  return false;
}

/// What is wrong with it, a line each; empty: nothing.
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

}  // namespace coursework::testing_tools
