#include "report/base/assets.h"

#include <stdexcept>

#include "mysim/base/files.h"
#include "mysim/base/installation.h"

namespace crosscheck {

std::string asset(const std::string& name) { return content_of_file(data_folder() / "report" / name); }

std::string content_of_file(const std::filesystem::path& file) {
  const std::string bytes = try_read_file(file).value_or("");
  if (bytes.empty()) throw std::runtime_error("cannot read " + file.string());
  return bytes;
}

}  // namespace crosscheck
