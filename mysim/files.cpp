// Whole files at once, and where they can be put.
#include "mysim/files.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cctype>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "mysim/errors.h"
#include "mysim/growing_file.h"

namespace crosscheck {
namespace fs = std::filesystem;

void write_file(const fs::path& file, std::string_view content) {
  GrowingFile growing(file);
  growing.append(content);
  growing.finish();
}

std::string read_file(const fs::path& file, std::string_view expected) {
  std::error_code unknown;
  const bool folder = fs::is_directory(file, unknown);
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  std::stringstream text;
  if (!folder && in && in.peek() == std::ifstream::traits_type::eof()) return "";  // << takes nothing for a failure
  if (folder || !in || !(text << in.rdbuf()))
    throw InputError(fmt::format("{}: cannot be read; expected {}{}", file.string(), expected,
                                 folder       ? ", got a folder"
                                 : errno != 0 ? fmt::format(" ({})", std::strerror(errno))
                                              : ""));
  return text.str();
}

void require_writable(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!fs::is_directory(folder) || access(folder.c_str(), W_OK | X_OK) != 0)
    throw InputError(fmt::format("--out {}: expected a folder that can be made and written to", folder.string()));
}

std::string file_name_of(std::string_view text) {
  std::string name(text);
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && std::string_view("._=+-").find(c) == std::string_view::npos)
      c = '-';
  return name;
}

}  // namespace crosscheck
