// The temporary name begins with a dot, so that it is not taken for a result.
#include "report/base/atomic_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <fstream>
#include <stdexcept>

namespace crosscheck::render {
namespace fs = std::filesystem;

AtomicFile::AtomicFile(const fs::path& file) : file_(file) {
  temporary_ = file.parent_path() / fmt::format(".{}.{}.tmp", file.filename().string(), getpid());
  const bool nameless = file.filename().empty() || fs::is_directory(file);
  if (nameless || !std::ofstream(temporary_, std::ios::binary))
    throw std::runtime_error("cannot write " + file.string());
}

AtomicFile::~AtomicFile() {
  std::error_code ignored;
  if (!temporary_.empty()) fs::remove(temporary_, ignored);
}

void AtomicFile::finish() {
  std::error_code error;
  fs::rename(temporary_, file_, error);
  if (error) throw std::runtime_error("cannot write " + file_.string() + ": " + error.message());
  temporary_.clear();
}

}  // namespace crosscheck::render
