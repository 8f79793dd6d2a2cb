// Text as numbers for toml++, which takes <charconv> where it has it: libc++ 14 has no from_chars for double, and what
// toml++ uses instead brings 138 kB of locales. The page's Number() rounds correctly, as <charconv> does.
#pragma once

#include <charconv>
#include <string>

/// The number that a text is, NaN where it is none.
extern "C" __attribute__((import_module("page"), import_name("number"))) double page_number(const char* text);

namespace std {

inline from_chars_result from_chars(const char* first, const char* last, double& value) {
  const string_view text(first, last), number = text.substr(0, text.find_first_not_of("+-.0123456789Ee"));
  value = page_number(string(number).c_str());
  const bool is_number = !number.empty() && value == value;  // Number() of nothing is 0
  return {is_number ? first + number.size() : first, is_number ? errc() : errc::invalid_argument};
}

}  // namespace std
