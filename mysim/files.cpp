// Whole files at once, and where they can be put.
#include "mysim/files.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cctype>

#include "mysim/errors.h"
#include "mysim/growing_file.h"

namespace crosscheck {
namespace fs = std::filesystem;

void write_file(const fs::path& file, std::string_view content) {
  GrowingFile growing(file);
  growing.append(content);
  growing.finish();
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
