// Parts of the standard library that toml++ needs and libc++ for WebAssembly lacks.
#pragma once

#include <charconv>
#include <fstream>
#include <istream>
#include <string>

// Files: none from version 19 on. toml++ mentions them; nothing here opens one.
#if defined(_LIBCPP_HAS_NO_FILESYSTEM) || (_LIBCPP_VERSION >= 200000 && !_LIBCPP_HAS_FILESYSTEM)
template <>
class std::basic_ifstream<char> : public std::istream {
 public:
  basic_ifstream() : std::istream(nullptr) {}
  void open(const std::string&, openmode) {}
  bool is_open() const { return false; }
};
#endif

// Text as numbers: libc++ before version 20 has no from_chars for double, and what toml++ uses instead brings 138 kB of
// locales. The page's Number() rounds correctly, as <charconv> does.
#if _LIBCPP_VERSION < 200000

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
#endif
