// A private folder that goes away with the object.
#pragma once

#include <filesystem>
#include <string_view>

namespace crosscheck {

struct TemporaryFolder {
  /// crosscheck-PURPOSE-XXXXXX where temporary files go. Throws InputError that names it when it cannot be made.
  explicit TemporaryFolder(std::string_view purpose);
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::filesystem::path path;
};

}  // namespace crosscheck
