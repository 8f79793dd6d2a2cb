// Text as numbers for toml++, which takes <charconv> where it has it: libc++ 14 has no from_chars for double, and what
// toml++ uses instead brings 138 kB of locales. The C library's strtod rounds correctly, as <charconv> does.
#pragma once

#include <charconv>
#include <cstdlib>
#include <string>

namespace std {

inline from_chars_result from_chars(const char* first, const char* last, double& value) {
  const string text(first, last);
  char* end = nullptr;
  value = strtod(text.c_str(), &end);
  if (end == text.c_str()) return {first, errc::invalid_argument};
  return {first + (end - text.c_str()), errc()};
}

}  // namespace std
