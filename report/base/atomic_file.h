// A file that other programs write under a temporary name next to it; it is renamed when it is whole.
#pragma once

#include <filesystem>

namespace crosscheck::render {

/// Opened before the work, so that a bad path is found at once; removed unless it becomes whole.
class AtomicFile {
 public:
  /// Throws std::runtime_error that names the file when it cannot be written.
  explicit AtomicFile(const std::filesystem::path& file);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  const std::filesystem::path& temporary() const { return temporary_; }
  /// Renames the file to its own name. Throws std::runtime_error that names the file.
  void finish();

 private:
  std::filesystem::path file_, temporary_;
};

}  // namespace crosscheck::render
