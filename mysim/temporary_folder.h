// A private folder that goes away with the object, or, where the process is killed, at the next start.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace crosscheck {

struct TemporaryFolder {
  /// crosscheck-PURPOSE-OWNER-XXXXXX where temporary files go; the owner is this process (see temporary_name()). Throws
  /// InputError that names it when it cannot be made.
  explicit TemporaryFolder(std::string_view purpose);
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::filesystem::path path;
};

/// A name for mkdtemp that tells the owner: its number, when it was started (clock ticks since the boot), and the
/// namespace in which the number means something.
std::string temporary_name(std::string_view purpose);

/// Removes the folders of processes that are gone, as far as they are this user's; root removes those that were lent to
/// other users too.
void sweep_temporary_folders();

}  // namespace crosscheck
