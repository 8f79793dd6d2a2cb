// Temporary name, then rename.
#include "mysim/files.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cctype>
#include <fstream>

#include "mysim/errors.h"

namespace crosscheck {
namespace fs = std::filesystem;

void write_file(const fs::path& file, std::string_view content) {
  std::error_code error;
  if (file.has_parent_path()) fs::create_directories(file.parent_path(), error);
  const fs::path temporary = fs::path(file) += fmt::format(".{}.part", getpid());
  {
    std::ofstream out(temporary, std::ios::binary);
    out.write(content.data(), static_cast<std::streamsize>(content.size()));
    out.close();
    if (!out) {
      fs::remove(temporary, error);
      throw InputError(
          fmt::format("{}: cannot be written; expected a folder with write permission and free space", file.string()));
    }
  }
  fs::rename(temporary, file, error);
  if (error) {
    const std::string why = error.message();
    fs::remove(temporary, error);
    throw InputError(fmt::format("{}: cannot be written: {}", file.string(), why));
  }
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
