// mkdtemp and remove_all.
#include "mysim/temporary_folder.h"

#include <fmt/format.h>

#include <cstdlib>
#include <string>

#include "mysim/errors.h"

namespace crosscheck {
namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder(std::string_view purpose) {
  std::string name = (fs::temp_directory_path() / fmt::format("crosscheck-{}-XXXXXX", purpose)).string();
  if (!mkdtemp(name.data()))
    throw InputError(fmt::format("{}: no folder can be made there; expected a place for temporary files", name));
  path = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path, ignored);
}

}  // namespace crosscheck
