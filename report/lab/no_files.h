// Replaces std::ifstream for a libc++ without files (WebAssembly, version 19 and later): toml++ uses the class, but the
// module opens no file.
#pragma once

#include <fstream>
#include <istream>
#include <string>

#if defined(_LIBCPP_HAS_NO_FILESYSTEM) || (_LIBCPP_VERSION >= 200000 && !_LIBCPP_HAS_FILESYSTEM)
template <>
class std::basic_ifstream<char> : public std::istream {
 public:
  basic_ifstream() : std::istream(nullptr) {}
  void open(const std::string&, openmode) {}
  bool is_open() const { return false; }
};
#endif
